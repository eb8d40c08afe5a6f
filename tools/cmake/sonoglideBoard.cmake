# What a person writes of a board: each mistake ends the configuration with the call and the argument.

# sonoglide_require_board_arguments(<call> <name> <keywords>...): of the board of that name. The caller has parsed its
# arguments as BOARD_...
function(sonoglide_require_board_arguments call name)
  string(LENGTH "${name}" characters)
  if(NOT name MATCHES "^[A-Za-z0-9_.+ -]+$" OR characters GREATER 16)  # of an identity: firmware/link/messages.hpp
    message(FATAL_ERROR "${call}: the name of a board has 1 to 16 letters, digits, blanks and signs of _.+-")
  endif()
  if(BOARD_UNPARSED_ARGUMENTS)
    list(JOIN ARGN ", " keywords)
    message(FATAL_ERROR "${call}: unknown: ${BOARD_UNPARSED_ARGUMENTS}; there are ${keywords}")
  endif()
  if(BOARD_KEYWORDS_MISSING_VALUES)
    list(JOIN BOARD_KEYWORDS_MISSING_VALUES ", " keywords)
    message(FATAL_ERROR "${call}: without a value: ${keywords}")
  endif()
  if(DEFINED BOARD_INTERRUPTS AND
      (NOT BOARD_INTERRUPTS MATCHES "^[1-9][0-9]*$" OR BOARD_INTERRUPTS GREATER 480))
    message(FATAL_ERROR "${call}: INTERRUPTS ${BOARD_INTERRUPTS}; allowed: a whole number from 1 to 480")
  endif()
endfunction()

# sonoglide_require_class(<call> <argument> <class> <header>): ends the configuration with the argument of that call
# where the header does not have the name of the class; a compiler would tell of it by pages.
function(sonoglide_require_class call argument class header)
  if(NOT class)
    message(FATAL_ERROR "${call}: ${argument} is missing")
  endif()
  file(READ "${header}" text)
  string(REGEX REPLACE "<.*" "" name "${class}")
  string(REGEX REPLACE ".*::" "" name "${name}")
  if(NOT text MATCHES "(^|[^A-Za-z0-9_])${name}($|[^A-Za-z0-9_])")
    message(FATAL_ERROR "${call}: ${argument} ${class}: there is no ${name} in ${header}; allowed: a class that it "
      "defines, or a name that it gives one by `using`")
  endif()
endfunction()
