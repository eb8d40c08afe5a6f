/// How the notch's sum is rounded to the scalar.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Rounds as the arithmetic does. That is far too little to be seen in the natural mode.
///
/// @tparam Depth  places of the delay line
template <class Scalar, std::size_t Depth, std::size_t TapCount>
class NotchRounding {
 public:
  using Taps = std::array<Scalar, TapCount>;

  explicit NotchRounding(const Taps&) {}
  void restart() {}
  Scalar sum(const Taps& taps, const Taps& inputs,
             const std::array<std::uint32_t, TapCount - 1>& /*places*/) {
    return numeric::dot(taps, inputs);
  }
};

/// In 16 bits the rounding errors e are steps of the drive like any other, and would excite an
/// undamped mode without end. So each error is followed by its own echoes (error feedback, Spang
/// 1962, ../README.md):
///   y = N(z) x + (1 + h1/h0 z^-M + h2/h0 z^-2M + ...) e.
/// Like N this has its zeros on the mode. The drive then moves by a code now and then, about an
/// amplitude that is finer than 16 bits.
///
/// Inputs in [0, 1), and taps whose magnitudes add up to at most 2.9: the sum then fits 32 bits.
template <class Overflow, std::size_t Depth, std::size_t TapCount>
class NotchRounding<numeric::Q15<Overflow>, Depth, TapCount> {
 public:
  using Scalar = numeric::Q15<Overflow>;
  using Taps = std::array<Scalar, TapCount>;
  using Places = std::array<std::uint32_t, TapCount - 1>;

  explicit NotchRounding(const Taps& taps) : NotchRounding(taps, Delays{}) {}

  void restart() { errors_ = {}; }

  /// @param taps    h0, h1, …
  /// @param inputs  what each tap takes
  /// @param places  in the delay line, of what is M, 2M, ... periods old; the last is the oldest
  Scalar sum(const Taps& taps, const Taps& inputs, const Places& places) {
    const std::int32_t exact = exact_sum(taps, inputs, places, Delays{});
    const std::int32_t rounded = numeric::shift_right_rounded(exact, Scalar::fraction_bits);
    errors_[places.back()] = static_cast<std::int16_t>(rounded * unit - exact);
    return Scalar::from_wide(rounded);
  }

 private:
  using Delays = std::make_index_sequence<TapCount - 1>;

  /// The magnitudes of all h/h0 add up to at most 4 for three taps and 16 for five; an error is at
  /// most 2^14 units.
  static constexpr int echo_bits = TapCount == 3 ? 14 : 13;
  static constexpr std::int32_t unit = std::int32_t{1} << Scalar::fraction_bits;

  template <std::size_t... I>
  NotchRounding(const Taps& taps, std::index_sequence<I...> /*delays*/)
      : echoes_{echo(taps[I + 1], taps[0])...} {}

  template <std::size_t... I>
  std::int32_t exact_sum(const Taps& taps, const Taps& inputs, const Places& places,
                         std::index_sequence<I...> /*delays*/) const {
    const std::int32_t echoes =
        numeric::shift_right_rounded((... + (echoes_[I] * errors_[places[I]])), echo_bits);
    return (product(taps[0], inputs[0]) + ... + product(taps[I + 1], inputs[I + 1])) + echoes;
  }

  static std::int32_t echo(Scalar tap, Scalar first) {
    return tap.raw() * (std::int32_t{1} << echo_bits) / first.raw();
  }
  static std::int32_t product(Scalar a, Scalar b) { return std::int32_t{a.raw()} * b.raw(); }

  std::array<std::int32_t, TapCount - 1> echoes_;  ///< h1/h0, h2/h0, ...
  std::array<std::int16_t, Depth> errors_{};       ///< in 2^-30
};

}  // namespace sonoglide::control
