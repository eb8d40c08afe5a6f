// Cortex-M, with or without a floating-point unit: from reset to main, and the vector table.
#include <cstdint>

#include "hal/start/begin_reset.hpp"
#include "hal/start/fill_memory.hpp"
#include "hal/start/image_end.hpp"

extern "C" {

// Addresses from sections.ld.
extern std::uint32_t stack_top[];
void take_unexpected();
void reset_entry();

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
      "bl leave_image \n");
}

// Of an image that defines begin_reset; the linker leaves it out of any other. Entered by the processor, with a stack.
[[gnu::naked, gnu::section(".boot.first"), noreturn]] void reset_first() {
  asm volatile(
      "bl begin_reset \n"
      "bl after_begin_reset \n");
}

}  // extern "C"

namespace {

struct VectorTable {
  std::uint32_t* initial_stack;
  void (*reset_entry)();
  void (*exceptions[14])();  ///< NMI to SysTick; every interrupt of the board stays off
};

[[gnu::section(".entry"), gnu::used]] const VectorTable vectors = {
    stack_top,
    reset_entry,
    {take_non_maskable_interrupt, take_hard_fault, take_unexpected, take_unexpected,
     take_unexpected, take_unexpected, take_unexpected, take_unexpected, take_unexpected,
     take_unexpected, take_unexpected, take_unexpected, take_unexpected, take_system_tick}};

}  // namespace
