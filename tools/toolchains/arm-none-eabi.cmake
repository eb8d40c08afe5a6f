# Bare-metal Arm with GCC; a toolchain file sets cpu_flags and includes this.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_EXECUTABLE_SUFFIX_CXX .elf)
# What CMake tries out cannot be linked without a board.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

string(JOIN " " CMAKE_CXX_FLAGS_INIT
  ${cpu_flags} -mthumb -O2 -ffp-contract=off -fno-exceptions -fno-rtti -fno-threadsafe-statics
  -ffunction-sections -fdata-sections -Wno-psabi)
# The C library without its start files and without system calls: what needs a heap or an operating
# system does not link.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostartfiles -Wl,--gc-sections -Wl,--fatal-warnings")

# The workstation program and GoogleTest are not for a microcontroller.
set(SONOGLIDE_HOST OFF)
set(SONOGLIDE_TESTS OFF)
