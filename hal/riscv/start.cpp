// RISC-V in machine mode, one hart, interrupts off: from reset to main.
#include "hal/start/begin_reset.hpp"
#include "hal/start/fill_memory.hpp"
#include "hal/start/image_end.hpp"

extern "C" {

// Naked: there is no stack yet. First in the image, where the processor starts.
[[gnu::naked, gnu::section(".entry"), noreturn]] void reset() {
  asm volatile(
      "la sp, stack_top \n"
      "la t0, take_trap \n"
      "csrw mtvec, t0 \n"
      "call fill_memory \n"
      "call main \n"
      "call leave_image \n");
}

// Of an image that defines begin_reset, before reset in the image; the linker leaves it out of any other.
[[gnu::naked, gnu::section(".entry.first"), noreturn]] void reset_first() {
  asm volatile(
      "la sp, stack_top \n"
      "la t0, take_trap \n"
      "csrw mtvec, t0 \n"
      "call begin_reset \n"
      "tail reset \n");
}

// The trap vector has to stand on a multiple of four.
[[gnu::naked, gnu::aligned(4), gnu::used, noreturn]] void take_trap() {
  asm volatile("tail take_unexpected \n");
}

}  // extern "C"
