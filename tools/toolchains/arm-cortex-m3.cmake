# Cortex-M3: floating point in software. The elimination of partial redundancies (PRE) would take the sign of a factor
# from its product, which then is four instructions in place of one.
set(cpu_flags -mcpu=cortex-m3 -mfloat-abi=soft -fno-tree-pre)
include("${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake")
