// The vectors of the board's interrupts, behind those of the processor. Only what calls enable_interrupt refers to
// them, and the linker leaves them out of any other image.
#include <cstddef>
#include <cstdint>

#include "hal/cortex_m/interrupts.hpp"

// Each handler is a weak name for one and the same, which a function of the image takes the place of.
#define TEXT_OF(number) #number
#define TEXT(macro) TEXT_OF(macro)
asm(".altmacro \n"
    ".macro interrupt_vector number \n"
    ".weak take_interrupt_\\number \n"
    ".thumb_set take_interrupt_\\number, take_other_interrupt \n"
    ".word take_interrupt_\\number \n"
    ".endm \n"
    ".pushsection .entry.interrupts, \"a\", %progbits \n"
    ".balign 4 \n"
    "interrupt_vectors: \n"
    ".set interrupt, 0 \n"
    ".rept " TEXT(SONOGLIDE_INTERRUPTS) " \n"
    "interrupt_vector %interrupt \n"
    ".set interrupt, interrupt + 1 \n"
    ".endr \n"
    ".popsection \n"
    ".noaltmacro \n");

extern "C" {

extern const std::uint32_t interrupt_vectors[];

// Naked: the link register tells on which stack the exception's frame is.
[[gnu::naked, gnu::used]] void take_other_interrupt() {
  asm volatile(
      "ldr r0, =take_unexpected \n"
      "bx r0 \n");
}

}  // extern "C"

namespace sonoglide::hal::cortex_m {

void enable_interrupt(std::size_t number, std::uint8_t priority) {
  asm volatile("" : : "r"(interrupt_vectors));
  auto* const priorities = reinterpret_cast<volatile std::uint32_t*>(0xE000E400);
  const std::size_t shift = 8 * (number % 4);
  priorities[number / 4] = (priorities[number / 4] & ~(0xffU << shift)) | std::uint32_t{priority}
                                                                              << shift;
  detail::let_come(number);
}

}  // namespace sonoglide::hal::cortex_m
