/// The peripherals of the chip are held in reset until they are released.
#pragma once

#include <cstdint>

#include "hal/pico/chip.hpp"

namespace sonoglide::hal::pico {

/// Source: Raspberry Pi, RP2040 and RP2350 Datasheets, subsystem resets.
struct ResetRegisters {
  volatile std::uint32_t held;
  volatile std::uint32_t by_watchdog;
  volatile std::uint32_t done;
};

extern "C" ResetRegisters reset_control;  ///< address from memory.ld

/// Inlined where it is used: the boot code must not call the program.
[[gnu::always_inline]] inline void release(std::uint32_t peripherals) {
  reset_control.held = reset_control.held & ~peripherals;
  while ((reset_control.done & peripherals) != peripherals) {
  }
}

}  // namespace sonoglide::hal::pico
