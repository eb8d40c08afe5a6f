/// What a Raspberry Pi Pico has of its own: RP2040.
/// Source: Raspberry Pi, RP2040 Datasheet; erratum E1 for the watchdog.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::pico {

/// No time for it: floating point is in software, and the observers' matrices take thousands of clocks.
inline constexpr bool fast = false;

inline constexpr std::uint32_t crystal_hz = 12000000;
/// 2,200 clocks in a carrier period of 60 kHz; the chip allows 133 MHz.
inline constexpr std::uint32_t system_hz = 132000000;
inline constexpr std::uint32_t system_oscillator_hz = 1320000000;  ///< 750 to 1600 MHz
/// From the same crystal: eight conversions of 100 clocks in a carrier period of 60 kHz.
inline constexpr std::uint32_t converter_hz = 48000000;

inline constexpr std::size_t carrier_interrupt = 4;

/// Clocks registers between those of the peripherals and of the converter.
inline constexpr std::size_t words_before_converter_clock = 5;

inline constexpr std::uint32_t reset_of_converter = 1U << 0;
inline constexpr std::uint32_t reset_of_transfers = 1U << 2;
inline constexpr std::uint32_t reset_of_pins = 1U << 5 | 1U << 8;  ///< and of their pads
inline constexpr std::uint32_t reset_of_system_pll = 1U << 12;
inline constexpr std::uint32_t reset_of_usb_pll = 1U << 13;
inline constexpr std::uint32_t reset_of_modulator = 1U << 14;
inline constexpr std::uint32_t reset_of_uart0 = 1U << 22;

inline constexpr std::uint32_t output_low = 2U << 8;
inline constexpr std::uint32_t output_enabled = 3U << 12;
inline constexpr std::uint32_t output_pad =
    1U << 2 | 1U << 4 | 1U << 6;  ///< pulled down, 4 mA, readable

inline constexpr std::uint32_t to_next_address = 1U << 5;
inline constexpr std::uint32_t in_ring_of_16_bytes = 4U << 6 | 1U << 10;
inline constexpr unsigned next_channel = 11;
inline constexpr std::uint32_t at_request_of_converter = 36U << 15;

inline constexpr std::uint32_t watchdog_counts_in_us = 2;
inline constexpr std::uint32_t all_but_oscillators = 0x1fffc;

extern "C" volatile std::uint32_t watchdog_tick;  ///< address from memory.ld

/// A tick for the watchdog in each microsecond.
inline void start_watchdog_ticks() {
  constexpr std::uint32_t ticking = 1U << 9;
  watchdog_tick = crystal_hz / 1000000 | ticking;
}

}  // namespace sonoglide::hal::pico
