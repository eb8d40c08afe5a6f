# 32-bit RISC-V with multiplication, atomics and compressed instructions, floating point in software;
# GCC and picolibc. The C++ headers are those of the Arm toolchain: Debian has none for RISC-V, and
# those in use depend on no processor.
file(GLOB cxx_headers LIST_DIRECTORIES ON /usr/lib/arm-none-eabi/include/c++/*)
if(NOT cxx_headers)
  message(FATAL_ERROR
    "No C++ headers: install libstdc++-arm-none-eabi-newlib, or run tools/setup test")
endif()
list(GET cxx_headers 0 cxx_headers)
set(picolibc /usr/lib/picolibc/riscv64-unknown-elf)

set(CMAKE_SYSTEM_PROCESSOR riscv)
set(CMAKE_CXX_COMPILER riscv64-unknown-elf-g++)
# Later specifications take the control registers out of the base, and GCC 12 then finds no 32-bit
# libgcc. No small data: no register points to it.
set(processor_flags
  -march=rv32imac -mabi=ilp32 -misa-spec=2.2 -msmall-data-limit=0
  -isystem "${cxx_headers}" -isystem "${cxx_headers}/arm-none-eabi/thumb/v7-m/nofp"
  -isystem "${picolibc}/include")
# Data may have code among it that runs from RAM (.ramfunc); its linker, unlike Arm's, warns of that.
set(linker_flags -Wl,--no-warn-rwx-segments -nostdlib "-L${picolibc}/lib/rv32imac/ilp32")
set(CMAKE_CXX_STANDARD_LIBRARIES_INIT "-Wl,--start-group -lc -lgcc -Wl,--end-group")
include("${CMAKE_CURRENT_LIST_DIR}/bare-metal.cmake")
