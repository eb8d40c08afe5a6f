/// The peripherals of the RP2040 are held in reset until they are released.
#pragma once

#include <cstdint>

namespace sonoglide::hal::pico {

/// Source: Raspberry Pi, RP2040 Datasheet, subsystem resets.
struct ResetRegisters {
  volatile std::uint32_t held;
  volatile std::uint32_t by_watchdog;
  volatile std::uint32_t done;
};

extern "C" ResetRegisters reset_control;  ///< address from memory.ld

inline constexpr std::uint32_t reset_of_converter = 1U << 0;
inline constexpr std::uint32_t reset_of_transfers = 1U << 2;
inline constexpr std::uint32_t reset_of_pins = 1U << 5 | 1U << 8;  // and of their pads
inline constexpr std::uint32_t reset_of_system_pll = 1U << 12;
inline constexpr std::uint32_t reset_of_usb_pll = 1U << 13;
inline constexpr std::uint32_t reset_of_modulator = 1U << 14;
inline constexpr std::uint32_t reset_of_uart0 = 1U << 22;

/// Inlined where it is used: the boot code must not call the program.
[[gnu::always_inline]] inline void release(std::uint32_t peripherals) {
  reset_control.held = reset_control.held & ~peripherals;
  while ((reset_control.done & peripherals) != peripherals) {
  }
}

}  // namespace sonoglide::hal::pico
