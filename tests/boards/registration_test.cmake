# A board that is registered wrongly, and controllers that cannot be built, end the configuration with what is wrong.
# SOURCE is the source tree, FOLDER for files; REGISTER, in a process of its own, are lines to be carried out.
cmake_minimum_required(VERSION 3.25)

if(DEFINED REGISTER)
  set(PROJECT_SOURCE_DIR "${SOURCE}")
  list(APPEND CMAKE_MODULE_PATH "${SOURCE}/tools/cmake")
  function(sonoglide_room)
  endfunction()
  set(SONOGLIDE_BOARD mine)
  include("${SOURCE}/tools/cmake/boards.cmake")
  cmake_language(EVAL CODE "${REGISTER}")
  return()
endif()

# refused(<lines> <message>)
function(refused lines message)
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DSOURCE=${SOURCE}" "-DREGISTER=${lines}" ${ARGN}
      -P "${CMAKE_SCRIPT_MODE_FILE}"
    RESULT_VARIABLE result ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " told "${output}")
  string(FIND "${told}" "${message}" at)
  if(result EQUAL 0 OR at EQUAL -1)
    message(FATAL_ERROR "${lines}\nis not refused by: ${message}\nbut: ${output}")
  endif()
endfunction()

set(call "sonoglide_emulated_board(mine")
set(right "${call} FOLDER hal/microbit SERIAL_BOARD microbit::SerialBoard")
refused("${call} FODLER hal/microbit)" "${call}): unknown: FODLER;hal/microbit; there are FOLDER, SERIAL_BOARD, MEMORY, ")
refused("${call} FOLDER)" "${call}): without a value: FOLDER")
refused("${call} SERIAL_BOARD microbit::SerialBoard)" "${call}): FOLDER is missing")
refused("${call} FOLDER hal/mcirobit)" "${call}): there is no hal/mcirobit/board.hpp")
refused("${call} FOLDER hal/microbit MEMORY mine.ld)" "${call}): there is no hal/microbit/mine.ld")
refused("${call} FOLDER hal/microbit)" "${call}): SERIAL_BOARD is missing")
refused("${call} FOLDER hal/microbit SERIAL_BOARD SreialBoard)"
  "${call}): SERIAL_BOARD SreialBoard: there is no SreialBoard in ")
refused("${right} INTERRUPTS -1)" "${call}): INTERRUPTS -1; allowed: a whole number from 1 to 480")
refused("${right})\n${right})" "${call}): there is a board mine already")
refused("set(SONOGLIDE_BOARD my_very_own_board)\nsonoglide_board(my_very_own_board FOLDER hal/template)"
  "sonoglide_board(my_very_own_board): the name of a board has 1 to 16 letters")
refused("sonoglide_carrier_board(mine FOLDER hal/pico CHIP rp2041)"
  "sonoglide_carrier_board(mine): there is no hal/pico/rp2041/memory.ld")

file(WRITE "${FOLDER}/a/same/controller_configuration.hpp" "")
file(WRITE "${FOLDER}/b/same/controller_configuration.hpp" "")
refused("" "SONOGLIDE_CONTROLLERS: ${FOLDER}/nowhere has no controller_configuration.hpp: sonoglide configure SCENE"
  -DCMAKE_CROSSCOMPILING=ON "-DSONOGLIDE_CONTROLLERS=${FOLDER}/nowhere")
refused("" "SONOGLIDE_CONTROLLERS: two folders are called same" -DCMAKE_CROSSCOMPILING=ON
  "-DSONOGLIDE_CONTROLLERS=${FOLDER}/a/same\\;${FOLDER}/b/same/")
