# Controller images for boards. On the workstation:
#
#   controller_header SCENE.toml > FOLDER/controller_configuration.hpp
#   cmake --preset BOARD -DSONOGLIDE_CONTROLLERS=FOLDER
#   cmake --build --preset BOARD
#
# leaves build/BOARD/bin/<name of FOLDER>.elf. A toolchain file without a board compiles the core
# alone.

sonoglide_room(sonoglide_lockstep hal/lockstep USES sonoglide_hal)

# sonoglide_board(<name> <linker script> CLASS <C++ class> HEADER <its header> USES <rooms>...):
# the board that images are linked for, if it is the one chosen.
function(sonoglide_board name memory)
  if(NOT name STREQUAL SONOGLIDE_BOARD)
    return()
  endif()
  cmake_parse_arguments(BOARD "" "CLASS;HEADER" "USES" ${ARGN})
  set(script "${PROJECT_SOURCE_DIR}/${memory}")
  set(sections "${PROJECT_SOURCE_DIR}/hal/start/sections.ld")
  add_library(sonoglide_board INTERFACE)
  target_link_libraries(sonoglide_board INTERFACE ${BOARD_USES})
  target_compile_definitions(sonoglide_board INTERFACE
    SONOGLIDE_BOARD_CLASS=${BOARD_CLASS} SONOGLIDE_BOARD_HEADER="${BOARD_HEADER}")
  target_link_options(sonoglide_board INTERFACE "-L${PROJECT_SOURCE_DIR}" "-T${script}")
  set_target_properties(sonoglide_board PROPERTIES INTERFACE_LINK_DEPENDS "${script};${sections}")
endfunction()

# sonoglide_image(<folder>): the image of one configured controller.
function(sonoglide_image folder)
  get_filename_component(name "${folder}" NAME)
  add_executable(${name} "${PROJECT_SOURCE_DIR}/firmware/app/image/main.cpp")
  target_include_directories(${name} PRIVATE "${folder}")
  target_link_libraries(${name} PRIVATE
    sonoglide_app sonoglide_board sonoglide_freestanding sonoglide_warnings)
endfunction()

if(CMAKE_CROSSCOMPILING)
  set(SONOGLIDE_BOARD "" CACHE STRING "Board that images are linked for")
  set(SONOGLIDE_CONTROLLERS "" CACHE STRING
    "Folders with a controller_configuration.hpp; each gives an image of its name")

  sonoglide_room(sonoglide_start hal/start)
  sonoglide_room(sonoglide_semihosting hal/semihosting USES sonoglide_lockstep sonoglide_start)
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL arm)
    sonoglide_room(sonoglide_cortex_m hal/cortex_m USES sonoglide_start)
  else()
    sonoglide_room(sonoglide_riscv hal/riscv USES sonoglide_start)
  endif()

  set(lockstep
    CLASS sonoglide::hal::semihosting::LockstepBoard HEADER hal/semihosting/lockstep_board.hpp
    USES sonoglide_semihosting)
  sonoglide_board(microbit hal/microbit/memory.ld ${lockstep} sonoglide_cortex_m)
  sonoglide_board(mps2-an385 hal/mps2/memory.ld ${lockstep} sonoglide_cortex_m)
  sonoglide_board(mps2-an386 hal/mps2/memory.ld ${lockstep} sonoglide_cortex_m)
  sonoglide_board(mps2-an500 hal/mps2/memory.ld ${lockstep} sonoglide_cortex_m)
  sonoglide_board(mps2-an505 hal/mps2/an505_memory.ld ${lockstep} sonoglide_cortex_m)
  sonoglide_board(netduinoplus2 hal/netduinoplus2/memory.ld ${lockstep} sonoglide_cortex_m)
  sonoglide_board(riscv32-virt hal/riscv_virt/memory.ld ${lockstep} sonoglide_riscv)

  if(SONOGLIDE_BOARD AND NOT TARGET sonoglide_board)
    message(FATAL_ERROR "No board is called ${SONOGLIDE_BOARD}: see tools/cmake/boards.cmake")
  endif()
  if(SONOGLIDE_CONTROLLERS AND NOT SONOGLIDE_BOARD)
    message(FATAL_ERROR "An image is for a board: set SONOGLIDE_BOARD, or use the board's preset")
  endif()
  foreach(folder IN LISTS SONOGLIDE_CONTROLLERS)
    sonoglide_image("${folder}")
  endforeach()
elseif(SONOGLIDE_HOST)
  add_executable(controller_header "${PROJECT_SOURCE_DIR}/tools/generate/controller_header.cpp")
  target_link_libraries(controller_header PRIVATE sonoglide_scene sonoglide_warnings)
endif()
