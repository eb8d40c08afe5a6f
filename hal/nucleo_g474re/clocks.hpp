/// Frequencies of a Nucleo-G474RE, as the boot code sets them.
#pragma once

#include <cstdint>

namespace sonoglide::hal::nucleo_g474re {

inline constexpr std::uint32_t crystal_hz = 24000000;
/// Of the processor, the buses and the timers: 2,800 clocks in a carrier period of 60 kHz; the chip allows
/// 170 MHz.
inline constexpr std::uint32_t system_hz = 168000000;

}  // namespace sonoglide::hal::nucleo_g474re
