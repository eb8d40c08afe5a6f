# What the functions of tools/cmake/boards.cmake say of wrong arguments of a board.
#
# cmake -DSOURCE=<of the project> -DFOLDER=<for files> -P board_arguments.cmake
# With -DCALL=<lines> it is such lines, of the board `product`; without, all of them are tried.
cmake_minimum_required(VERSION 3.25)

if(CALL)
  function(sonoglide_room)  # a script has no targets
  endfunction()
  list(APPEND CMAKE_MODULE_PATH "${SOURCE}/tools/cmake")
  set(PROJECT_SOURCE_DIR "${SOURCE}")
  set(SONOGLIDE_BOARD product)
  include(boards)
  cmake_language(EVAL CODE "${CALL}")
  message("taken")
  return()
endif()

# says(<lines> <part of what is said> [<-Dname=value>...])
function(says call reason)
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DSOURCE=${SOURCE}" "-DCALL=${call}" ${ARGN} -P "${CMAKE_CURRENT_LIST_FILE}"
    OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  string(FIND "${said}" "${reason}" at)
  if(at EQUAL -1)
    message(SEND_ERROR "${call}\nExpected: ${reason}\nSaid: ${said}")
  endif()
endfunction()

set(board "sonoglide_board(product")
set(carrier "sonoglide_carrier_board(product")
set(emulated "sonoglide_emulated_board(product")

says("${board} FOLDER hal/template CLASS template_board::Board)" "taken")
says("${carrier} FOLDER hal/nucleo_g474re HARDWARE nucleo_g474re::Hardware SERIAL_BOARD nucleo_g474re::SerialBoard)"
  "taken")
says("${emulated} FOLDER hal/mps2 MEMORY an505_memory.ld SERIAL_BOARD mps2::An505SerialBoard)" "taken")
says("sonoglide_board(another FOLDER hal/nowhere)" "taken")  # is not the board that is built

says("${board} FOLDR hal/template CLASS template_board::Board)"
  "sonoglide_board(product): unknown: FOLDR;hal/template; there are FOLDER, CLASS, INTERRUPTS")
says("${carrier} FOLDER hal/pico MEMORY memory.ld)" "sonoglide_carrier_board(product): unknown: MEMORY;memory.ld;")
says("${emulated} FOLDER hal/mps2 ENCODER)" "sonoglide_emulated_board(product): unknown: ENCODER;")
foreach(function board carrier emulated)
  says("${${function}})" "(product): FOLDER is missing")
  says("${${function}} FOLDER hal/nowhere)" "(product): there is no hal/nowhere/board.hpp")
endforeach()
says("${carrier} FOLDER hal/pico CHIP rp9999)" "(product): there is no hal/pico/rp9999/memory.ld")
says("${emulated} FOLDER hal/mps2 MEMORY an1_memory.ld)" "(product): there is no hal/mps2/an1_memory.ld")
says("${board} FOLDER hal/template)" "(product): CLASS is missing")
says("${carrier} FOLDER hal/nucleo_g474re SERIAL_BOARD nucleo_g474re::SerialBoard)" "(product): HARDWARE is missing")
says("${emulated} FOLDER hal/mps2)" "(product): SERIAL_BOARD is missing")
says("${board} FOLDER hal/template CLASS template_board::Bored)"
  "(product): CLASS template_board::Bored: there is no Bored in")
says("${carrier} FOLDER hal/nucleo_g474re HARDWARE nucleo_g474re::Hardware SERIAL_BOARD nucleo_g474re::Serial)"
  "(product): SERIAL_BOARD nucleo_g474re::Serial: there is no Serial in")
says("${emulated} FOLDER hal/mps2 SERIAL_BOARD mps2::An385SerialBoard TIMED_HARDWARE mps2::An385Hardware)"
  "(product): TIMED_HARDWARE mps2::An385Hardware: there is no An385Hardware in")
says("${emulated} FOLDER)" "(product): without a value: FOLDER")
foreach(number -1 0 481 many)
  says("${emulated} FOLDER hal/mps2 INTERRUPTS ${number})"
    "(product): INTERRUPTS ${number}; allowed: a whole number from 1 to 480")
endforeach()
says("${board} FOLDER hal/template CLASS template_board::Board)\n${emulated} FOLDER hal/mps2)"
  "sonoglide_emulated_board(product): there is a board product already")
says("set(SONOGLIDE_BOARD a_very_long_board)\nsonoglide_board(a_very_long_board FOLDER hal/template)"
  "sonoglide_board(a_very_long_board): the name of a board has 1 to 16 letters")

foreach(folder a b)
  file(WRITE "${FOLDER}/${folder}/same/controller_configuration.hpp" "")
endforeach()
says("#" "SONOGLIDE_CONTROLLERS: ${FOLDER}/nowhere has no controller_configuration.hpp: sonoglide configure SCENE"
  -DCMAKE_CROSSCOMPILING=ON "-DSONOGLIDE_CONTROLLERS=${FOLDER}/nowhere")
says("#" "SONOGLIDE_CONTROLLERS: two folders are called same" -DCMAKE_CROSSCOMPILING=ON
  "-DSONOGLIDE_CONTROLLERS=${FOLDER}/a/same\\;${FOLDER}/b/same/")
