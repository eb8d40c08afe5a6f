// From reset to main, and what every exception ends in.
#include <cstdint>

#include "hal/mps2/semihosting.hpp"

extern "C" {

// Addresses from memory.ld.
extern std::uint32_t stack_top[];
extern const std::uint32_t data_image[];
extern std::uint32_t data_begin[];
extern std::uint32_t data_end[];
extern std::uint32_t bss_begin[];
extern std::uint32_t bss_end[];

void fill_memory() {
  const std::uint32_t* from = data_image;
  for (std::uint32_t* to = data_begin; to != data_end; ++to) {
    *to = *from++;
  }
  for (std::uint32_t* to = bss_begin; to != bss_end; ++to) {
    *to = 0;
  }
}

[[noreturn]] void leave_image(int code) {
  sonoglide::hal::mps2::leave(static_cast<sonoglide::hal::mps2::ExitCode>(code));
}

[[noreturn]] void take_exception() {
  sonoglide::hal::mps2::leave(sonoglide::hal::mps2::ExitCode::processor_fault);
}

// Naked: the compiler may put no floating-point instruction before the unit is enabled.
[[gnu::naked, noreturn]] void reset() {
#ifdef __ARM_FP
  asm volatile(
      "ldr r0, =0xE000ED88 \n"  // CPACR
      "ldr r1, [r0] \n"
      "orr r1, r1, #0xF00000 \n"  // coprocessors 10 and 11: full access
      "str r1, [r0] \n"
      "dsb \n"
      "isb \n"
      "movs r1, #0 \n"  // round to nearest, subnormals kept, NaN payloads kept
      "vmsr fpscr, r1 \n");
#endif
  asm volatile(
      "bl fill_memory \n"
      "bl main \n"
      "b leave_image \n");
}

}  // extern "C"

namespace {

struct VectorTable {
  std::uint32_t* initial_stack;
  void (*reset)();
  void (*exceptions[14])();  ///< NMI to SysTick; every interrupt of the board stays off
};

[[gnu::section(".vectors"), gnu::used]] const VectorTable vectors = {
    stack_top,
    reset,
    {take_exception, take_exception, take_exception, take_exception, take_exception, take_exception,
     take_exception, take_exception, take_exception, take_exception, take_exception, take_exception,
     take_exception, take_exception}};

}  // namespace
