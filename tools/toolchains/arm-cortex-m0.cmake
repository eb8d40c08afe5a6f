# Cortex-M0: floating point in software, no divide instruction.
set(cpu_flags -mcpu=cortex-m0 -mfloat-abi=soft)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
