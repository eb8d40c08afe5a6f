# Cortex-M33 with its single-precision floating-point unit.
set(cpu_flags -mcpu=cortex-m33 -mfpu=fpv5-sp-d16 -mfloat-abi=hard)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
