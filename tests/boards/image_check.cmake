# What an image is linked of: no double in software, no heap, no exceptions, no system call. Its
# size is printed. Usage: cmake -DNM=… -DSIZE=… -DIMAGE=… -P image_check.cmake
execute_process(COMMAND "${NM}" "${IMAGE}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(NOT symbols MATCHES " T main\n")
  message(FATAL_ERROR "${IMAGE}: no symbol table")
endif()
string(REGEX MATCHALL
  "[^\n]*(__aeabi_d|malloc|_Znw|_Zdl|__cxa|nwind|abort|_sbrk)[^\n]*" forbidden "${symbols}")
if(forbidden)
  list(JOIN forbidden "\n" forbidden)
  message(FATAL_ERROR "${IMAGE} holds\n${forbidden}")
endif()
execute_process(COMMAND "${SIZE}" "${IMAGE}" COMMAND_ERROR_IS_FATAL ANY)
