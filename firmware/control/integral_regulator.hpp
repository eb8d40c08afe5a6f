/// Integral feedback on the friction ratio.
#pragma once

#include <cstdint>

#include "firmware/control/signals.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// commanded ratio = target + integral of (reference − measured), in [0, 1].
///
/// The loop is closed in friction ratio, in front of the inverse map, so that its gain is near 1 at
/// every operating point. All ratios on base 2.
///
/// A changed target takes the delay of shaper, plant and sensor until the measured ratio shows it.
/// The reference is what the reading should be meanwhile: the target behind a first-order lag with
/// the mean of that delay, so that a change adds nothing to the integral on balance. A change above
/// small_change() holds the integral for hold_periods instead, which disturbs it not at all, but
/// once in rest_periods at most: a target that keeps changing does not switch feedback off.
template <class Scalar>
class IntegralRegulator {
 public:
  struct Parameters {
    Scalar gain;    ///< per carrier period
    Scalar follow;  ///< of the reference towards the target, per carrier period; > 0
    std::uint16_t hold_periods;
    std::uint16_t rest_periods;  ///< between two holds for a changed target
  };

  /// A friction ratio of 1/256, on base 2.
  static constexpr Scalar small_change() { return numeric::from_real<Scalar>(1.0 / 512.0); }

  static constexpr void scale_gain(Parameters& parameters, Scalar factor) {
    parameters.gain *= factor;
  }

  explicit IntegralRegulator(const Parameters& parameters) : parameters_(parameters) {}

  void restart() {
    integral_ = {};
    rest_ = 0;
    hold();
  }

  /// Holds the integral for the next `hold_periods` calls of propose().
  void hold() {
    held_ = parameters_.hold_periods;
    lag_ = {};
  }

  /// @param change  from the target before to the new one
  void target_changes(Scalar change) {
    lag_ += change;
    if (rest_ == 0 && small_change() < numeric::abs(change)) {
      rest_ = parameters_.rest_periods;
      hold();
    }
  }

  /// A better known friction force, in terms of which the target was another ratio so far: what the
  /// integral has made up for of that is taken from it.
  /// @param shown  that ratio
  void shift(Scalar target, Scalar shown) {
    integral_ += numeric::accumulate(target - shown);
    hold();
  }

  /// Commanded ratio, with the new error counted in; nothing is kept before accept().
  Scalar propose(Scalar target, Scalar measured) {
    error_ = numeric::observe<signal::RatioError>(target - lag_ - measured);
    proposed_ =
        held_ == 0 ? integral_ + numeric::accumulated_product(parameters_.gain, error_) : integral_;
    return numeric::observe<signal::CommandedRatio>(numeric::clamp(
        target + numeric::rounded<Scalar>(proposed_), Scalar{}, numeric::from_real<Scalar>(0.5)));
  }

  /// Keeps the proposed integral, unless the command stood at a bound and the error pushes further.
  /// @param at_most_drive   the drive cannot be raised to lower the ratio further
  /// @param at_least_drive  the drive cannot be lowered to raise the ratio further
  void accept(bool at_most_drive, bool at_least_drive) {
    const bool winding_up =
        (at_most_drive && error_ < Scalar{}) || (at_least_drive && Scalar{} < error_);
    if (!winding_up) {
      integral_ = numeric::observe<signal::RatioIntegral>(proposed_);
    }
    if (held_ > 0) {
      --held_;
    }
    if (rest_ > 0) {
      --rest_;
    }
    catch_up();
  }

 private:
  /// What is below the resolution is no lag.
  void catch_up() {
    const Scalar step = parameters_.follow * lag_;
    lag_ = step == Scalar{} ? step : lag_ - step;
  }

  Parameters parameters_;
  numeric::Accumulator<Scalar> integral_{};
  numeric::Accumulator<Scalar> proposed_{};
  Scalar lag_{};  ///< of the reference behind the target
  Scalar error_{};
  std::uint16_t held_ = 0;
  std::uint16_t rest_ = 0;
};

}  // namespace sonoglide::control
