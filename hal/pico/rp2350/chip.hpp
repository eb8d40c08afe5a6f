/// What a Raspberry Pi Pico 2 has of its own: RP2350, as Arm and secure.
/// Source: Raspberry Pi, RP2350 Datasheet; erratum E9 for the pads.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::pico {

/// Time for floating point and for an observer.
inline constexpr bool fast = true;

inline constexpr std::uint32_t crystal_hz = 12000000;
/// 2,500 clocks in a carrier period of 60 kHz; the chip allows 150 MHz.
inline constexpr std::uint32_t system_hz = 150000000;
inline constexpr std::uint32_t system_oscillator_hz = 1500000000;  ///< 750 to 1600 MHz
/// From the same crystal: eight conversions of 100 clocks in a carrier period of 60 kHz.
inline constexpr std::uint32_t converter_hz = 48000000;

inline constexpr std::size_t carrier_interrupt = 8;

/// Clocks registers between those of the peripherals and of the converter.
inline constexpr std::size_t words_before_converter_clock = 8;

inline constexpr std::uint32_t reset_of_converter = 1U << 0;
inline constexpr std::uint32_t reset_of_transfers = 1U << 2;
inline constexpr std::uint32_t reset_of_pins = 1U << 6 | 1U << 9;  ///< and of their pads
inline constexpr std::uint32_t reset_of_system_pll = 1U << 14;
inline constexpr std::uint32_t reset_of_usb_pll = 1U << 15;
inline constexpr std::uint32_t reset_of_modulator = 1U << 16;
inline constexpr std::uint32_t reset_of_uart0 = 1U << 26;

inline constexpr std::uint32_t output_low = 2U << 12;
inline constexpr std::uint32_t output_enabled = 3U << 14;
/// Pulled down, 4 mA. Not readable: the pull-down of a pad that is read may not bring it low again.
inline constexpr std::uint32_t output_pad = 1U << 2 | 1U << 4;

inline constexpr std::uint32_t to_next_address = 1U << 6;
inline constexpr std::uint32_t in_ring_of_16_bytes = 4U << 8 | 1U << 12;
inline constexpr unsigned next_channel = 13;
inline constexpr std::uint32_t at_request_of_converter = 48U << 17;

inline constexpr std::uint32_t watchdog_counts_in_us = 1;
inline constexpr std::uint32_t all_but_oscillators = 0x1fffff3;

/// Of the watchdog, among those of other users.
struct TickRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t clocks;
};
extern "C" TickRegisters watchdog_ticks;  ///< address from memory.ld

/// A tick for the watchdog in each microsecond.
inline void start_watchdog_ticks() {
  watchdog_ticks.clocks = crystal_hz / 1000000;
  watchdog_ticks.control = 1;
}

}  // namespace sonoglide::hal::pico
