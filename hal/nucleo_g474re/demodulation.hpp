/// From the conversions of a carrier period to the phasor of what they show.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::nucleo_g474re {

inline constexpr std::size_t conversions_in_period = 16;

/// See hal::VibrationSample: codes whose full scale is 2^31.
struct Phasor {
  std::int32_t in_phase;
  std::int32_t quadrature;
};

/// Phasor of x cos θ - y sin θ, of which a period is converted at θ = 2π (i + 1/2) / 16, i = 0 … 15:
///
///   x = 1/8 sum v_i cos θ_i, y = -1/8 sum v_i sin θ_i.
///
/// What is constant and every harmonic but the 15th, 17th, … falls out. Rounded to 14 bits; limited to them.
///
/// @param codes  of 12 bits, offset binary
inline Phasor demodulated(const std::uint16_t* codes) {
  // cos of (1, 3, 5, 7) π/16 in 2^-15; the sines are the same, backwards.
  constexpr std::array<std::int32_t, 4> cosines = {32138, 27246, 18205, 6393};
  std::array<std::int32_t, 8> odd{};  // what changes sign after half a period
  for (std::size_t i = 0; i < 8; ++i) {
    odd[i] = std::int32_t{codes[i]} - codes[i + 8];
  }
  std::int32_t x = 0;
  std::int32_t y = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    x += cosines[i] * (odd[i] - odd[7 - i]);
    y -= cosines[3 - i] * (odd[i] + odd[7 - i]);
  }
  // 2^29 is full scale.
  const auto rounded = [](std::int32_t sum) {
    constexpr std::int32_t largest = 0x1fff;
    const std::int32_t code = (sum + (1 << 15)) >> 16;
    const std::int32_t limited = code > largest ? largest : code < -largest ? -largest : code;
    return limited * (1 << 18);
  };
  return {rounded(x), rounded(y)};
}

}  // namespace sonoglide::hal::nucleo_g474re
