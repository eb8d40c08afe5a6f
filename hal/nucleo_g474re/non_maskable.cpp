// What the chip tells by its non-maskable interrupt.
// Source: ST, RM0440, embedded flash memory: error code correction; RCC: clock security system.
#include <cstdint>

#include "hal/nucleo_g474re/board.hpp"
#include "hal/start/image_end.hpp"

namespace sonoglide::hal::nucleo_g474re {
namespace {

constexpr std::uint32_t unreadable = 1U << 31;
constexpr std::uint32_t crystal_failed = 1U << 8;

constexpr std::uint32_t noted = 0xC7A15700;
[[gnu::section(".noinit.crystal")]] std::uint32_t note;  ///< anything after power-on

}  // namespace

// The services' alone, so in flash.
[[gnu::section(".text.service")]] bool Watchdog::crystal_failed() {
  const bool failed = note == noted;
  note = 0;
  return failed;
}

}  // namespace sonoglide::hal::nucleo_g474re

/// A word that a power cut spoilt has more errors than can be corrected. It reads as anything, and its
/// checksum then tells; the reading goes on. All else ends the image; the crystal's failure is told after the reset.
extern "C" void take_non_maskable_interrupt() {
  using namespace sonoglide::hal::nucleo_g474re;
  if ((flash_control.correction & unreadable) == 0) {
    note = (clock_control.interrupts & crystal_failed) != 0 ? noted : 0;
    take_exception();
  }
  flash_control.correction = unreadable;
}
