/// Command shaping that leaves the plant's natural mode unexcited.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/control/notch_rounding.hpp"

namespace sonoglide::control {

/// Three taps on the drive amplitude, with zeros on the natural mode:
///   N(z) = h0 + h1 z^-M + h2 z^-2M,
///   h = (1, −2 e^(−σMT) cos(ωd M T), e^(−2σMT)) / sum,
/// −σ ± iωd the natural mode, T the carrier period.
///
/// The amplitude changes at drive phase 0 only. So the free response is linear in the steps of the
/// amplitude, and vanishes 2M periods after the last one. M is the smallest spacing for which every
/// tap is within ±1.
/// Source: Singer 1990 (input shaping), Tuttle 1994 (zeros placed on the mode), see README.md.
///
/// @tparam MaxSpacing  largest M; the delay line holds 2·MaxSpacing amplitudes.
template <class ScalarT, int MaxSpacing>
class NotchShaper {
 public:
  using Scalar = ScalarT;
  static constexpr int max_spacing = MaxSpacing;

  struct Parameters {
    std::array<Scalar, 3> taps;
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
    past_ = {};
    rounding_.restart();
    oldest_ = 0;
  }

  /// Shaped amplitude; may leave [0, 1] where the input varies within 2M periods.
  Scalar shape(Scalar amplitude) {
    const std::uint32_t depth = 2 * spacing();
    const std::uint32_t oldest = oldest_;
    const std::uint32_t ahead = oldest + spacing();
    const std::uint32_t middle = ahead < depth ? ahead : ahead - depth;
    const std::array<Scalar, 3> inputs{amplitude, past_[middle], past_[oldest]};
    const Scalar shaped = rounding_.sum(parameters_.taps, inputs, middle, oldest);
    past_[oldest] = amplitude;
    oldest_ = oldest + 1 < depth ? oldest + 1 : 0;
    return shaped;
  }

 private:
  /// A constant where the delay line leaves no choice.
  std::uint32_t spacing() const { return MaxSpacing == 1 ? 1 : parameters_.spacing; }

  Parameters parameters_;
  [[no_unique_address]] NotchRounding<Scalar, 2 * MaxSpacing> rounding_;
  std::array<Scalar, 2 * MaxSpacing> past_{};
  std::uint32_t oldest_ = 0;
};

}  // namespace sonoglide::control
