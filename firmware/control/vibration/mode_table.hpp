/// What a controller knows of a natural mode whose frequency it does not know exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Places of the numbers of a row of the table. Matrices are row by row.
namespace mode {

inline constexpr std::size_t rotation = 0;       ///< d cos θ and d sin θ, of a period
inline constexpr std::size_t input_gain = 2;     ///< B: what a change of the amplitude adds
inline constexpr std::size_t forced = 4;         ///< H: steady vibration at full drive
inline constexpr std::size_t output = 6;         ///< C: vibration of a mode of 1
inline constexpr std::size_t mode_gain = 10;     ///< of the observer
inline constexpr std::size_t offset_gain = 14;   ///< likewise
inline constexpr std::size_t feedback = 18;      ///< K: on the mode and on the amplitude's error
inline constexpr std::size_t inverse = 21;       ///< H/|H|²
inline constexpr std::size_t per_velocity = 23;  ///< 1/|H|
inline constexpr std::size_t numbers = 24;
/// The slopes of those before this one are of use.
inline constexpr std::size_t sloped = mode_gain;

/// Over the range of natural frequencies, equally far apart.
inline constexpr int row_bits = 4;
inline constexpr std::size_t rows = (1U << row_bits) + 1;

}  // namespace mode

template <class Scalar>
using ModeRow = std::array<Scalar, mode::numbers>;
template <class Scalar>
using ModeTable = std::array<ModeRow<Scalar>, mode::rows>;

/// x/4 on base 1 of an x on base 2^(n + 2).
template <class Scalar>
constexpr Scalar lowered(Scalar x, int n) {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return n < 0 ? numeric::scale_by_power_of_two(x, n) : numeric::lifted(x, n);
  } else {
    return x * static_cast<Scalar>(0.25);
  }
}

/// A table at a frequency between its rows: linear interpolation, to 2^-27 of the way from one to
/// the next, and the slope there.
template <class Scalar>
class ModeInterpolation {
 public:
  /// @param table                its rows, over the natural frequency
  /// @param frequency_parameter  from -1 at the first row to 1 at the last
  void go(const ModeTable<Scalar>& table, Scalar frequency_parameter) {
    constexpr int shift = 32 - mode::row_bits;
    const std::int32_t code = numeric::to_code(frequency_parameter);
    constexpr int middle = 1 << (mode::row_bits - 1);
    const int below = (code >> shift) + middle;
    const auto row = static_cast<std::size_t>(below);
    const Scalar along = numeric::from_code<Scalar>(
        static_cast<std::int32_t>((static_cast<std::uint32_t>(code) << mode::row_bits) >> 1));
    const ModeRow<Scalar>& low = table[row];
    const ModeRow<Scalar>& high = table[row + 1];
    for (std::size_t i = 0; i < mode::numbers; ++i) {
      const Scalar rise = high[i] - low[i];
      values_[i] = low[i] + rise * along;
      if (i < mode::sloped) {
        slopes_[i] = slope_of(rise);
      }
    }
  }

  Scalar operator[](std::size_t i) const { return values_[i]; }
  /// Over the frequency parameter.
  Scalar slope(std::size_t i) const { return slopes_[i]; }

 private:
  /// From one row to the next the frequency parameter moves by 2/16.
  static Scalar slope_of(Scalar rise) {
    constexpr int steep = mode::row_bits - 1;
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      return numeric::lifted(rise, steep);
    } else {
      return rise * numeric::power_of_two<Scalar>(steep);
    }
  }

  ModeRow<Scalar> values_{};
  std::array<Scalar, mode::sloped> slopes_{};
};

}  // namespace sonoglide::control
