/// How the notch's sum is rounded to the scalar.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Rounds as the arithmetic does. That is far too little to be seen in the natural mode.
///
/// @tparam Depth  places of the delay line
template <class Scalar, std::size_t Depth>
class NotchRounding {
 public:
  explicit NotchRounding(const std::array<Scalar, 3>&) {}
  void restart() {}
  Scalar sum(const std::array<Scalar, 3>& taps, const std::array<Scalar, 3>& inputs,
             std::uint32_t /*middle*/, std::uint32_t /*oldest*/) {
    return numeric::dot(taps, inputs);
  }
};

/// In 16 bits the rounding errors e are steps of the drive like any other, and would excite an
/// undamped mode without end. So each error is followed by its own echoes (error feedback, Spang
/// 1962, README.md):
///   y = N(z) x + (1 + h1/h0 z^-M + h2/h0 z^-2M) e.
/// Like N this has its zeros on the mode. The drive then moves by a code now and then, about an
/// amplitude that is finer than 16 bits.
///
/// Inputs in [0, 1): the sum then fits 32 bits, whatever the taps.
template <class Overflow, std::size_t Depth>
class NotchRounding<numeric::Q15<Overflow>, Depth> {
 public:
  using Scalar = numeric::Q15<Overflow>;

  explicit NotchRounding(const std::array<Scalar, 3>& taps)
      : middle_echo_(echo(taps[1], taps[0])), last_echo_(echo(taps[2], taps[0])) {}

  void restart() { errors_ = {}; }

  /// @param middle  place in the delay line of what is M periods old
  /// @param oldest  of what is 2M periods old
  Scalar sum(const std::array<Scalar, 3>& taps, const std::array<Scalar, 3>& inputs,
             std::uint32_t middle, std::uint32_t oldest) {
    const std::int32_t echoes = numeric::shift_right_rounded(
        middle_echo_ * errors_[middle] + last_echo_ * errors_[oldest], echo_bits);
    const std::int32_t exact = product(taps[0], inputs[0]) + product(taps[1], inputs[1]) +
                               product(taps[2], inputs[2]) + echoes;
    const std::int32_t rounded = numeric::shift_right_rounded(exact, Scalar::fraction_bits);
    errors_[oldest] = static_cast<std::int16_t>(rounded * unit - exact);
    return Scalar::from_wide(rounded);
  }

 private:
  static constexpr int echo_bits = 14;  ///< h1/h0 lies in [-2, 2]
  static constexpr std::int32_t unit = std::int32_t{1} << Scalar::fraction_bits;

  static std::int32_t echo(Scalar tap, Scalar first) {
    return tap.raw() * (std::int32_t{1} << echo_bits) / first.raw();
  }
  static std::int32_t product(Scalar a, Scalar b) { return std::int32_t{a.raw()} * b.raw(); }

  std::int32_t middle_echo_;                  ///< h1/h0
  std::int32_t last_echo_;                    ///< h2/h0
  std::array<std::int16_t, Depth> errors_{};  ///< in 2^-30
};

}  // namespace sonoglide::control
