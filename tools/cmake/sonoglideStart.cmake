# sonoglide::start: from reset to main on a Cortex-M or a 32-bit RISC-V. Its sources are compiled with
# the image that links it; the image has a linker script and an end of its own, as in hal/template.
# sonoglide_timed_board() adds units on a board of the project's own. A project with Sonoglide as a subdirectory
# includes this file from there.
if(NOT sonoglide_DATA_FOLDER)
  get_filename_component(sonoglide_DATA_FOLDER "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
endif()
if(TARGET sonoglide::start)
  return()
endif()

include("${CMAKE_CURRENT_LIST_DIR}/sonoglideChecksum.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/sonoglideBoard.cmake")

add_library(sonoglide::start INTERFACE IMPORTED)
target_sources(sonoglide::start INTERFACE
  "${sonoglide_DATA_FOLDER}/hal/start/fill_memory.cpp"
  "${sonoglide_DATA_FOLDER}/hal/$<IF:$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},arm>,cortex_m,riscv>/start.cpp"
  $<$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},arm>:${sonoglide_DATA_FOLDER}/hal/cortex_m/vectors.cpp>)
target_compile_features(sonoglide::start INTERFACE cxx_std_17)
target_include_directories(sonoglide::start INTERFACE "${sonoglide_DATA_FOLDER}")
# The script of a board includes hal/start/sections.ld.
target_link_options(sonoglide::start INTERFACE "-L${sonoglide_DATA_FOLDER}")

# sonoglide_timed_board(<name> HEADER <header> HARDWARE <class in it> MEMORY <linker script>
#   [INTERRUPTS <number>] SOURCES <files>... CONTROLLERS <folders>...)
#
# A board of the project's own that keeps its own time: each folder that `sonoglide configure` wrote gives the
# executable <name of the folder>_unit, with parameters, link and watchdog. HARDWARE is a class as in
# hal/template/unit.hpp; hosts show <name>. SOURCES are the board's, with its shutdown(), leave_image() and
# take_exception(). Includes are relative to the folder of the caller. INTERRUPTS: see hal/README.md.
function(sonoglide_timed_board name)
  cmake_parse_arguments(PARSE_ARGV 1 BOARD "" "HEADER;HARDWARE;MEMORY;INTERRUPTS" "SOURCES;CONTROLLERS")
  sonoglide_require_board_arguments("sonoglide_timed_board(${name})" "${name}"
    HEADER HARDWARE MEMORY INTERRUPTS SOURCES CONTROLLERS)
  foreach(argument HEADER HARDWARE MEMORY SOURCES CONTROLLERS)
    if(NOT BOARD_${argument})
      message(FATAL_ERROR "sonoglide_timed_board(${name}): ${argument} is missing")
    endif()
  endforeach()
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(arm|riscv(32)?)$")
    message(FATAL_ERROR "sonoglide_timed_board(${name}): this is a build for ${CMAKE_SYSTEM_PROCESSOR}; allowed: a "
      "CMAKE_TOOLCHAIN_FILE of Sonoglide's folder toolchains, or one that sets CMAKE_SYSTEM_PROCESSOR to arm, riscv or riscv32")
  endif()
  get_filename_component(header "${BOARD_HEADER}" ABSOLUTE)
  if(EXISTS "${header}")  # else the compiler may find it elsewhere
    sonoglide_require_class("sonoglide_timed_board(${name})" HARDWARE "${BOARD_HARDWARE}" "${header}")
  endif()
  get_filename_component(memory "${BOARD_MEMORY}" ABSOLUTE)
  if(NOT EXISTS "${memory}")
    message(FATAL_ERROR "sonoglide_timed_board(${name}): MEMORY ${BOARD_MEMORY}: there is no ${memory}")
  endif()
  foreach(folder IN LISTS BOARD_CONTROLLERS)
    get_filename_component(folder "${folder}" ABSOLUTE)
    if(NOT EXISTS "${folder}/controller_configuration.hpp")
      message(FATAL_ERROR "sonoglide_timed_board(${name}): ${folder} has no controller_configuration.hpp: "
        "sonoglide configure SCENE --out ${folder} writes it")
    endif()
    get_filename_component(controller "${folder}" NAME)
    set(target ${controller}_unit)
    if(TARGET ${target})
      message(FATAL_ERROR "sonoglide_timed_board(${name}): there is a target ${target} already, of another board or a "
        "folder of the same name: give ${folder} another name")
    endif()
    add_executable(${target} "${sonoglide_DATA_FOLDER}/firmware/image/timed_unit.cpp"
      "${sonoglide_DATA_FOLDER}/hal/exception/kept_exception.cpp" ${BOARD_SOURCES})
    target_include_directories(${target} PRIVATE "${folder}" "${CMAKE_CURRENT_SOURCE_DIR}")
    target_compile_definitions(${target} PRIVATE
      "SONOGLIDE_BOARD_CLASS=${BOARD_HARDWARE}"
      "SONOGLIDE_BOARD_HEADER=\"${BOARD_HEADER}\""
      "SONOGLIDE_BOARD_NAME=\"${name}\""
      $<$<BOOL:${BOARD_INTERRUPTS}>:SONOGLIDE_INTERRUPTS=${BOARD_INTERRUPTS}>)
    target_link_libraries(${target} PRIVATE sonoglide::app sonoglide::timed sonoglide::start)
    target_link_options(${target} PRIVATE "-T${memory}")
    set_target_properties(${target} PROPERTIES LINK_DEPENDS "${memory}")
    sonoglide_image_checksum(${target})
  endforeach()
endfunction()
