# fmu.dll, the same library for Windows, by the cross compiler mingw-w64. It takes as long to compile as
# half the program.
set(windows_engine "${PROJECT_BINARY_DIR}/lib/sonoglide/fmu.dll")
if(NOT SONOGLIDE_FMU_WINDOWS)
  file(REMOVE "${windows_engine}")  # the program would pack that of an earlier build
  return()
endif()
find_program(SONOGLIDE_MINGW x86_64-w64-mingw32-g++-posix REQUIRED)

# The headers of libraries, without those of this system in the folders around them.
set(folder "${CMAKE_CURRENT_BINARY_DIR}/windows")
file(MAKE_DIRECTORY "${folder}/include")
foreach(header fmt/format.h toml++/toml.h nlohmann/json.hpp)
  find_path(place ${header} NO_CACHE REQUIRED)
  cmake_path(GET header PARENT_PATH library)
  file(CREATE_LINK "${place}/${library}" "${folder}/include/${library}" SYMBOLIC)
  unset(place)
endforeach()
get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)

# What CMake has made and the two versions of the interface are compiled one by one, the other files
# of each room as one.
set(units "${CMAKE_CURRENT_SOURCE_DIR}/libraries/compiled_in.cpp"
  "${PROJECT_SOURCE_DIR}/host_sim/process/printable.cpp")
set(rooms ${shared_rooms} fmi_binary)
list(REMOVE_ITEM rooms process)  # the rest of which is of this system
foreach(room IN LISTS rooms)
  get_target_property(sources sonoglide_${room} SOURCES)
  set(united "")
  foreach(source IN LISTS sources)
    cmake_path(IS_PREFIX PROJECT_BINARY_DIR "${source}" made)
    if(made OR room STREQUAL fmi_binary)
      list(APPEND units "${source}")
    else()
      string(APPEND united "#include \"${source}\"\n")
    endif()
  endforeach()
  if(united)
    file(CONFIGURE OUTPUT "${folder}/${room}.cpp" CONTENT "${united}" @ONLY)
    list(APPEND units "${folder}/${room}.cpp")
  endif()
endforeach()

set(objects "")
foreach(unit IN LISTS units)
  cmake_path(GET unit STEM name)
  set(object "${folder}/${name}.o")
  add_custom_command(
    OUTPUT "${object}"
    COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} "${SONOGLIDE_MINGW}" -std=c++17 -O2 -ffp-contract=off
      -ffunction-sections -fdata-sections -DTOML_HEADER_ONLY=0
      "-I${PROJECT_SOURCE_DIR}" "-I${folder}/include" "-I${eigen}"
      -MD -MF "${object}.d" -c "${unit}" -o "${object}"
    DEPENDS "${unit}"
    DEPFILE "${object}.d"
    COMMENT "Compiling ${name} for Windows"
    VERBATIM)
  list(APPEND objects "${object}")
endforeach()
add_custom_command(
  OUTPUT "${windows_engine}"
  COMMAND "${SONOGLIDE_MINGW}" -shared -static -s -Wl,--gc-sections -Wl,--no-insert-timestamp
    ${objects} -o "${windows_engine}"
  DEPENDS ${objects}
  COMMENT "Linking ${windows_engine}"
  VERBATIM)
add_custom_target(sonoglide_fmu_windows DEPENDS "${windows_engine}")
add_dependencies(sonoglide_fmu sonoglide_fmu_windows)
