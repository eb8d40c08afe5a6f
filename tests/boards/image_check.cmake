# What an image is linked of: no double (neither Arm's routines nor those of GCC for other
# processors), no heap, no exceptions, no system call. Its size is printed.
# Usage: cmake -DBINUTILS=prefix -DIMAGE=… -P image_check.cmake
execute_process(COMMAND "${BINUTILS}-nm" "${IMAGE}"
  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(NOT symbols MATCHES " T main\n")
  message(FATAL_ERROR "${IMAGE}: no symbol table")
endif()
set(double "__aeabi_d|__aeabi_[a-z0-9]+2d|__[a-z]+df")
set(library "malloc|_Znw|_Zdl|__cxa|nwind|abort|_sbrk")
string(REGEX MATCHALL "[^\n]*(${double}|${library})[^\n]*" forbidden "${symbols}")
if(forbidden)
  list(JOIN forbidden "\n" forbidden)
  message(FATAL_ERROR "${IMAGE} holds\n${forbidden}")
endif()
# A floating-point unit for doubles needs no routine for them.
execute_process(COMMAND "${BINUTILS}-objdump" --disassemble "${IMAGE}"
  OUTPUT_VARIABLE instructions COMMAND_ERROR_IS_FATAL ANY)
if(instructions MATCHES "[^\n]*\\.f64[^\n]*")
  message(FATAL_ERROR "${IMAGE} computes with double:\n${CMAKE_MATCH_0}")
endif()
execute_process(COMMAND "${BINUTILS}-size" "${IMAGE}" COMMAND_ERROR_IS_FATAL ANY)
