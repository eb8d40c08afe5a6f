// An image with handlers of its own for two interrupts of the board: it asks for them, then has its vectors in RAM
// and asks again, and at last lets one come for which it has no handler. What came, and after a reset the exception
// that was kept, go out in a line.
#include SONOGLIDE_BOARD_HEADER

#include <cstddef>
#include <cstdint>

#include "hal/cortex_m/interrupts.hpp"
#include "hal/kept_exception.hpp"
#include "send_number.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
using sonoglide::image_test::send;
namespace cortex_m = sonoglide::hal::cortex_m;

volatile std::uint32_t came;  // a decimal digit for each, in the order in which they came

void note(std::uint32_t digit) {
  came = 10 * came + digit;
}

/// As the device would.
void request(std::size_t number) {
  auto* const pending = reinterpret_cast<volatile std::uint32_t*>(0xE000E200);
  pending[number / 32] = 1U << (number % 32);
  asm volatile("dsb \n isb \n");
}

}  // namespace

extern "C" void take_interrupt_5() {
  note(1);
  request(31);  // of a higher priority: it comes at once
  note(3);
}

extern "C" void take_interrupt_31() {
  note(2);
}

int main() {
  Hardware::ByteLink bytes;
  if (const auto* const kept = sonoglide::hal::take_kept_exception()) {
    send(bytes, kept->exception, '\n');
    return 0;
  }
  cortex_m::enable_interrupt(5, 0x80);
  cortex_m::enable_interrupt(31, 0x40);
  request(5);
#if !defined(__ARM_ARCH_6M__)
  cortex_m::take_interrupt(8, [] { note(4); });
  cortex_m::take_interrupt(9, [] { note(5); });
  request(8);
  request(9);
  request(31);
#endif
  send(bytes, came, '\n');
  cortex_m::enable_interrupt(7, 0);
  request(7);
}
