# Cortex-M3: floating point in software.
set(cpu_flags -mcpu=cortex-m3 -mfloat-abi=soft)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
