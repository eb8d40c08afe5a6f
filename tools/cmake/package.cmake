# What others use of this project: aliases inside a build, and the installed package, which holds the
# same targets, the headers, the toolchain files, the board to start from, scenes and documents.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# No file of the package depends on the machine that installs it, but for the first line of the scenes.
set(SONOGLIDE_INCLUDE_FOLDER "${CMAKE_INSTALL_INCLUDEDIR}/sonoglide")
set(SONOGLIDE_DATA_FOLDER "${CMAKE_INSTALL_DATADIR}/sonoglide")
set(SONOGLIDE_PACKAGE_FOLDER "${CMAKE_INSTALL_DATADIR}/cmake/sonoglide")

# sonoglide_offer(<names>...): target sonoglide_<name> is sonoglide::<name> to others. All of them are
# header-only.
function(sonoglide_offer)
  foreach(name IN LISTS ARGN)
    add_library(sonoglide::${name} ALIAS sonoglide_${name})
    set_target_properties(sonoglide_${name} PROPERTIES EXPORT_NAME ${name})
  endforeach()
  set_property(GLOBAL PROPERTY SONOGLIDE_OFFERED ${ARGN})
endfunction()

# sonoglide_install_headers(<target>): the headers of a room themselves, not the links to them.
function(sonoglide_install_headers target)
  get_target_property(folder ${target} SONOGLIDE_FOLDER)
  if(folder)
    file(GLOB headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*.hpp")
    install(FILES ${headers} DESTINATION "${SONOGLIDE_INCLUDE_FOLDER}/${folder}" COMPONENT core)
    target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${SONOGLIDE_INCLUDE_FOLDER}>)
  endif()
endfunction()

# The offered rooms as a CMake package, and for who uses no CMake as a pkg-config module.
function(sonoglide_install_package)
  get_property(offered GLOBAL PROPERTY SONOGLIDE_OFFERED)
  foreach(name IN LISTS offered)
    sonoglide_install_headers(sonoglide_${name})
    install(TARGETS sonoglide_${name} EXPORT sonoglide_core COMPONENT core)
  endforeach()
  install(EXPORT sonoglide_core NAMESPACE sonoglide:: FILE sonoglideCore.cmake
    DESTINATION "${SONOGLIDE_PACKAGE_FOLDER}" COMPONENT core)

  set(made "${PROJECT_BINARY_DIR}/package")
  configure_package_config_file("${PROJECT_SOURCE_DIR}/tools/cmake/sonoglideConfig.cmake.in"
    "${made}/sonoglideConfig.cmake" INSTALL_DESTINATION "${SONOGLIDE_PACKAGE_FOLDER}"
    PATH_VARS SONOGLIDE_DATA_FOLDER NO_CHECK_REQUIRED_COMPONENTS_MACRO)
  write_basic_package_version_file("${made}/sonoglideConfigVersion.cmake"
    COMPATIBILITY SameMajorVersion ARCH_INDEPENDENT)
  install(FILES "${made}/sonoglideConfig.cmake" "${made}/sonoglideConfigVersion.cmake"
      "${PROJECT_SOURCE_DIR}/tools/cmake/sonoglideStart.cmake"
      "${PROJECT_SOURCE_DIR}/tools/cmake/sonoglideChecksum.cmake"
      "${PROJECT_SOURCE_DIR}/tools/cmake/sonoglideBoard.cmake"
    DESTINATION "${SONOGLIDE_PACKAGE_FOLDER}" COMPONENT core)

  set(pkg_config_folder "${CMAKE_INSTALL_DATADIR}/pkgconfig")
  # From there to the prefix, wherever it is moved.
  string(REGEX REPLACE "[^/]+" ".." to_prefix "${pkg_config_folder}")
  configure_file("${PROJECT_SOURCE_DIR}/tools/cmake/sonoglide.pc.in" "${made}/sonoglide.pc" @ONLY)
  install(FILES "${made}/sonoglide.pc" DESTINATION "${pkg_config_folder}" COMPONENT core)
endfunction()

# What a port starts from, and what is read.
function(sonoglide_install_data)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/tools/toolchains"
    DESTINATION "${SONOGLIDE_DATA_FOLDER}" COMPONENT core)
  foreach(folder start exception cortex_m riscv template)
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/hal/${folder}"
      DESTINATION "${SONOGLIDE_DATA_FOLDER}/hal" COMPONENT core)
  endforeach()
  install(FILES "${PROJECT_SOURCE_DIR}/firmware/image/timed_unit.cpp"
    DESTINATION "${SONOGLIDE_DATA_FOLDER}/firmware/image" COMPONENT core)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${SONOGLIDE_DATA_FOLDER}" COMPONENT core)

  install(CODE "set(SCENES \"${PROJECT_SOURCE_DIR}/host_sim/scenes\")
    set(STAGED \"${PROJECT_BINARY_DIR}/package/scenes\")
    set(FOLDER \"\${CMAKE_INSTALL_PREFIX}/${SONOGLIDE_DATA_FOLDER}/scenes\")
    include(\"${PROJECT_SOURCE_DIR}/tools/cmake/scenes.cmake\")" COMPONENT documents)
  install(CODE "set(SOURCE \"${PROJECT_SOURCE_DIR}\")
    set(FOLDER \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}\")
    include(\"${PROJECT_SOURCE_DIR}/tools/cmake/documents.cmake\")" COMPONENT documents)
endfunction()

function(sonoglide_install)
  sonoglide_install_package()
  sonoglide_install_data()
  if(TARGET sonoglide)
    install(TARGETS sonoglide RUNTIME COMPONENT program OPTIONAL)
    # Where the program looks for it.
    install(TARGETS sonoglide_fmu LIBRARY DESTINATION lib/sonoglide COMPONENT program OPTIONAL)
    install(FILES "${PROJECT_BINARY_DIR}/lib/sonoglide/fmu.dll"
      DESTINATION lib/sonoglide COMPONENT program OPTIONAL)
  endif()
  if(TARGET sonoglide_python_module)
    # Where Debian's interpreter looks for it. A wheel holds the same files.
    set(folder lib/python3/dist-packages/sonoglide)
    install(TARGETS sonoglide_python_module LIBRARY DESTINATION "${folder}"
      COMPONENT python OPTIONAL)
    install(TARGETS sonoglide_fmu LIBRARY DESTINATION "${folder}/engine"
      COMPONENT python OPTIONAL)
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/host_sim/python/sonoglide/" DESTINATION "${folder}"
      COMPONENT python FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN py.typed)
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/host_sim/python/notebooks" DESTINATION "${folder}"
      COMPONENT python FILES_MATCHING PATTERN "*.ipynb")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/host_sim/scenes" DESTINATION "${folder}"
      COMPONENT python FILES_MATCHING PATTERN "*.toml")
  endif()
endfunction()
