# What the functions of tools/cmake/boards.cmake say of wrong arguments of a board.
#
# cmake -DSOURCE=<of the project> -P board_arguments.cmake
# With -DCALL=<line> it is such a line, of the board `product`; without, all of them are tried.
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

# says(<line> <part of what is said>)
function(says call reason)
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DSOURCE=${SOURCE}" "-DCALL=${call}" -P "${CMAKE_CURRENT_LIST_FILE}"
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
  "sonoglide_board(product): unknown: FOLDR;hal/template; the arguments are in tools/cmake/boards.cmake")
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
