/// Command shaping that leaves the plant's natural mode unexcited.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/limits/notch_rounding.hpp"

namespace sonoglide::control {

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
