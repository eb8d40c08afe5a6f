/// Command shaping that leaves the plant's natural mode unexcited.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Rounds the notch's sum to the scalar, as the arithmetic does. That is far too little to be seen in the
/// natural mode.
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

/// No command shaping: for plants without a natural mode, and to show the effect of the notch.
template <class ScalarT>
class NoShaping {
 public:
  static constexpr PartName part_name{"limits/notch_shaper", "NoShaping"};
  using Scalar = ScalarT;
  struct Parameters {};

  explicit NoShaping(const Parameters&) {}
  void restart() {}
  Scalar shape(Scalar amplitude) { return amplitude; }
};

/// Taps on the drive amplitude, with zeros on the natural mode or about it:
///   N(z) = h0 + h1 z^-M + h2 z^-2M + ...
/// Three taps have one pair of zeros, on the mode:
///   h = (1, −2 e^(−σMT) cos(ωd M T), e^(−2σMT)) / sum,
/// −σ ± iωd the natural mode, T the carrier period. Five taps are two such filters in a row, each
/// with zeros of its own: for a mode that is not known exactly.
///
/// The amplitude changes at drive phase 0 only. So the free response is linear in the steps of the
/// amplitude, and vanishes (TapCount − 1) M periods after the last one where the mode is on a zero.
/// No partial sum of the taps leaves [0, 1]: the shaped step does not overshoot.
/// Source: Singer 1990 (input shaping), Tuttle 1994 (zeros placed on the mode), see ../README.md.
///
/// @tparam MaxSpacing  largest M; the delay line holds (TapCount − 1)·MaxSpacing amplitudes.
/// @tparam TapCount    3 or 5
template <class ScalarT, int MaxSpacing, std::size_t TapCount = 3>
class NotchShaper {
 public:
  static constexpr PartName part_name{"limits/notch_shaper", "NotchShaper"};
  using Scalar = ScalarT;
  static constexpr std::size_t tap_count = TapCount;

  struct Parameters {
    std::array<Scalar, TapCount> taps;
    std::uint8_t spacing;  ///< M, 1 … MaxSpacing

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("taps", self.taps);
      visit("spacing", self.spacing);
    }
  };

  explicit NotchShaper(const Parameters& parameters)
      : parameters_(parameters), rounding_(parameters.taps) {}

  void restart() {
    for (Scalar& past : past_) {
      past = {};
    }
    rounding_.restart();
    oldest_ = 0;
  }

  /// Shaped amplitude; may leave [0, 1] where the input varies within (TapCount − 1) M periods.
  Scalar shape(Scalar amplitude) { return shape(amplitude, std::make_index_sequence<delays>{}); }

 private:
  static constexpr std::uint32_t delays = TapCount - 1;
  static constexpr std::size_t length = std::size_t{delays} * MaxSpacing;

  /// A constant where the delay line leaves no choice.
  std::uint32_t spacing() const { return MaxSpacing == 1 ? 1 : parameters_.spacing; }

  template <std::size_t... I>
  Scalar shape(Scalar amplitude, std::index_sequence<I...> /*delays*/) {
    const std::uint32_t depth = delays * spacing();
    const std::uint32_t oldest = oldest_;
    // Where the delay line holds what is M, 2M, ... periods old.
    const std::array<std::uint32_t, delays> ahead{
        oldest + static_cast<std::uint32_t>(delays - 1 - I) * spacing()...};
    const std::array<std::uint32_t, delays> places{
        (I + 1 == delays || ahead[I] < depth ? ahead[I] : ahead[I] - depth)...};
    const std::array<Scalar, TapCount> inputs{amplitude, past_[places[I]]...};
    const Scalar shaped = rounding_.sum(parameters_.taps, inputs, places);
    past_[oldest] = amplitude;
    oldest_ = oldest + 1 < depth ? oldest + 1 : 0;
    return shaped;
  }

  Parameters parameters_;
  [[no_unique_address]] NotchRounding<Scalar, length, TapCount> rounding_;
  // No std::array: with it a compiler forgets the parameters at each store to a place that varies.
  Scalar past_[length]{};
  std::uint32_t oldest_ = 0;
};

}  // namespace sonoglide::control
