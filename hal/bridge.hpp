/// A carrier of pulses: its period, and from an amplitude to the pulses of a full bridge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sonoglide::hal {

namespace detail {

constexpr unsigned table_bits = 10;
constexpr unsigned width_bits = 13;  ///< a half width of 1 is half of a carrier period

/// Error below 1e-9 for 0 … pi/2; the compiler's alone.
constexpr double sine(double angle) {
  double term = angle;
  double sum = angle;
  for (int i = 1; i < 8; ++i) {
    term *= -angle * angle / ((2 * i) * (2 * i + 1));
    sum += term;
  }
  return sum;
}

/// asin(i / 2^table_bits) / pi with width_bits, to nearest.
constexpr auto half_widths() {
  constexpr double pi = 3.14159265358979323846;
  constexpr std::size_t last = std::size_t{1} << table_bits;
  constexpr std::uint16_t widest = 1U << (width_bits - 1);
  std::array<std::uint16_t, last + 1> widths{};
  std::uint16_t width = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    const double amplitude = static_cast<double>(i) / static_cast<double>(last);
    while (width < widest && sine(pi * (width + 0.5) / (2 * widest)) < amplitude) {
      ++width;
    }
    widths[i] = width;
  }
  return widths;
}

inline constexpr auto half_width_table = half_widths();

}  // namespace detail

/// Whether so many ticks of a clock are a carrier period, as exactly as a crystal gives the clock.
constexpr bool is_period(std::uint32_t ticks, std::uint32_t clock_hz, double period_s) {
  constexpr double crystal_tolerance = 30e-6;
  if (ticks == 0) {
    return false;
  }
  const double error = period_s * clock_hz / ticks - 1.0;
  return -crystal_tolerance < error && error < crystal_tolerance;
}

/// Half of the width of the pulses of a bridge that is driven by one pulse of either sign in each carrier
/// period, half a period apart and centred on the drive's phases 0 and pi. The voltage between the legs then
/// has no even harmonic, and a fundamental of
///
///   sin(pi w / half_period) of full scale, which is 4/pi of the supply; its phase is always 0.
///
/// @param amplitude    code, 0 … 2^31; reached within 1/2048 + pi / (2 half_period) + pi / 2^14 of full scale
/// @param half_period  clocks, below 2^16
/// @return w, clocks
constexpr std::uint32_t half_width_of(std::uint32_t amplitude, std::uint32_t half_period) {
  constexpr unsigned unused = 31 - detail::table_bits;
  const std::uint32_t index = (amplitude + (1U << (unused - 1))) >> unused;
  const std::uint32_t width = detail::half_width_table[index];
  // A tie is rounded down: both legs together are high for a period at most.
  return (width * half_period + (1U << (detail::width_bits - 1)) - 1) >> detail::width_bits;
}

}  // namespace sonoglide::hal
