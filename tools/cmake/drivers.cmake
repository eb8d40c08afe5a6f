# The drivers of every board, compiled by a workstation's clang for their own processors: nothing is
# linked, but so they stand in the compile database, where clang-tidy finds them (tools/tidy). The
# libraries' headers are those of the Arm toolchain; what is used of them depends on no processor.

file(GLOB cxx_headers LIST_DIRECTORIES ON /usr/lib/arm-none-eabi/include/c++/*)
if(NOT cxx_headers)
  message(FATAL_ERROR "No C++ headers for boards: run tools/setup test")
endif()
list(GET cxx_headers 0 cxx_headers)

# sonoglide_drivers(<name> FLAGS <of the processor>... FOLDERS <folders of hal>...): their sources, and
# one that includes all of their headers.
function(sonoglide_drivers name)
  cmake_parse_arguments(DRIVERS "" "" "FLAGS;FOLDERS" ${ARGN})
  set(sources "")
  set(includes "")
  foreach(folder IN LISTS DRIVERS_FOLDERS)
    file(GLOB own CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*.cpp")
    file(GLOB headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}"
      "${PROJECT_SOURCE_DIR}/${folder}/*.hpp")
    list(APPEND sources ${own})
    list(TRANSFORM headers REPLACE "(.+)" "#include \"\\1\"\n")
    string(APPEND includes ${headers})
  endforeach()
  set(check "${PROJECT_BINARY_DIR}/drivers/${name}.cpp")
  file(CONFIGURE OUTPUT "${check}" CONTENT "${includes}" @ONLY)
  add_library(drivers_${name} OBJECT ${sources} "${check}")
  target_compile_features(drivers_${name} PRIVATE cxx_std_17)
  target_compile_options(drivers_${name} PRIVATE ${DRIVERS_FLAGS} -ffreestanding
    -fno-exceptions -fno-rtti
    "SHELL:-isystem ${cxx_headers}" "SHELL:-isystem ${cxx_headers}/arm-none-eabi/thumb/v7-m/nofp"
    "SHELL:-isystem /usr/lib/arm-none-eabi/include")
  target_include_directories(drivers_${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(drivers_${name} PRIVATE sonoglide_warnings)
endfunction()

sonoglide_drivers(arm FLAGS --target=thumbv7em-none-eabi
  FOLDERS hal hal/start hal/timed hal/halt hal/lockstep hal/lockstep/board hal/semihosting
    hal/exception hal/cortex_m hal/cortex_m/loaded hal/microbit hal/mps2 hal/netduinoplus2
    hal/pico hal/pico/rp2040 hal/template)
target_compile_definitions(drivers_arm PRIVATE "SONOGLIDE_CHIP_HEADER=\"hal/pico/rp2040/chip.hpp\"")
# Peripherals of other boards have the same names.
sonoglide_drivers(g474 FLAGS --target=thumbv7em-none-eabi FOLDERS hal/nucleo_g474re)
target_compile_definitions(drivers_g474 PRIVATE SONOGLIDE_ENCODER_COUNTS_PER_M=1e6)
sonoglide_drivers(rp2350 FLAGS --target=thumbv8m.main-none-eabi FOLDERS hal/pico hal/pico/rp2350)
target_compile_definitions(drivers_rp2350 PRIVATE "SONOGLIDE_CHIP_HEADER=\"hal/pico/rp2350/chip.hpp\"")
sonoglide_drivers(riscv FLAGS --target=riscv32-unknown-elf -march=rv32imac -mabi=ilp32
  FOLDERS hal/exception hal/semihosting hal/riscv hal/riscv_virt)
