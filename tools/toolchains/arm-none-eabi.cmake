# Bare-metal Arm with GCC and newlib; a toolchain file sets cpu_flags and includes this.
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(processor_flags ${cpu_flags} -mthumb -Wno-psabi)
include("${CMAKE_CURRENT_LIST_DIR}/bare-metal.cmake")
