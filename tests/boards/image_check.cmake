# What images are linked of: no double (neither Arm's routines nor those of GCC for other
# processors), no heap, no exceptions, no run-time types, no mathematical library, no formatted
# print, no system call. Their sizes are printed.
# Usage: cmake -DBINUTILS=prefix -DIMAGES=image,… -P image_check.cmake
set(double "__aeabi_d|__aeabi_[a-z0-9]+2d|__[a-z]+df")
set(library "malloc|_Znw|_Zdl|__cxa|nwind|personality|_ZT[ISV]|dynamic_cast|abort|_sbrk|print|puts")
set(mathematics "a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p)?|pow|sqrt|cbrt|hypot|fm(a|in|ax|od)")
string(APPEND mathematics "|floor|ceil|trunc|l?l?round|[a-z]*rint|ldexp|frexp|modf|scalbl?n")

# check(<image>): fails where it holds what it may not.
function(check image)
  execute_process(COMMAND "${BINUTILS}-nm" "${image}"
    OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  if(NOT symbols MATCHES " T main\n")
    message(FATAL_ERROR "${image}: no symbol table")
  endif()
  string(REGEX MATCHALL
    "[^\n]*(${double}|${library}| (${mathematics})f?\n|__ieee754|__kernel)[^\n]*"
    forbidden "${symbols}")
  if(forbidden)
    list(JOIN forbidden "\n" forbidden)
    message(FATAL_ERROR "${image} holds\n${forbidden}")
  endif()
  # A floating-point unit for doubles needs no routine for them.
  execute_process(COMMAND "${BINUTILS}-objdump" --disassemble "${image}"
    OUTPUT_VARIABLE instructions COMMAND_ERROR_IS_FATAL ANY)
  if(instructions MATCHES "[^\n]*\\.f64[^\n]*")
    message(FATAL_ERROR "${image} computes with double:\n${CMAKE_MATCH_0}")
  endif()
endfunction()

string(REPLACE "," ";" IMAGES "${IMAGES}")
foreach(image IN LISTS IMAGES)
  check("${image}")
endforeach()
execute_process(COMMAND "${BINUTILS}-size" ${IMAGES} COMMAND_ERROR_IS_FATAL ANY)
