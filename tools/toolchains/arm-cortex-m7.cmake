# Cortex-M7 with its double-precision floating-point unit.
set(cpu_flags -mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
