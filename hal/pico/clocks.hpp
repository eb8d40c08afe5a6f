/// Frequencies of a Raspberry Pi Pico, as the boot code sets them.
#pragma once

#include <cstdint>

namespace sonoglide::hal::pico {

inline constexpr std::uint32_t crystal_hz = 12000000;
/// 2,200 clocks in a carrier period of 60 kHz; the chip allows 133 MHz.
inline constexpr std::uint32_t system_hz = 132000000;
/// From the same crystal: eight conversions of 100 clocks in a carrier period of 60 kHz.
inline constexpr std::uint32_t converter_hz = 48000000;

}  // namespace sonoglide::hal::pico
