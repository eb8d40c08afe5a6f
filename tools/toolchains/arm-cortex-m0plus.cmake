# Cortex-M0+ with a multiplier of one cycle: floating point in software, no divide instruction.
set(cpu_flags -mcpu=cortex-m0plus -mfloat-abi=soft)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
