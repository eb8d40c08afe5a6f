/// Integral feedback on the friction ratio.
#pragma once

#include <cstdint>

#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/interface/ratio.hpp"
#include "firmware/control/interface/signals.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// No feedback: the target goes to the feedforward as it is.
/// The commands are those of an IntegralRegulator with a gain
/// of 0.
template <class ScalarT>
class NoFeedback {
 public:
  using Scalar = ScalarT;
  static constexpr PartName part_name{"feedback/integral_regulator", "NoFeedback"};
  struct Parameters {};

  static constexpr void scale_gain(Parameters&, Scalar) {}

  explicit NoFeedback(const Parameters&) {}
  void restart(Scalar) {}
  void hold() {}
  void target_changes(Scalar) {}
  void shift(Scalar, Scalar) {}
  template <class VelocityOf>
  static constexpr void learn_scale(const VelocityOf&) {}
  static constexpr Scalar scaled(Scalar velocity) { return velocity; }
  static constexpr Scalar implied(Scalar ratio) { return ratio; }
  Scalar propose(Scalar target, Scalar /*measured*/) const { return target; }
  void accept(bool, bool) {}
};

/// commanded ratio = target + integral of (reference − measured), in [0, 1].
///
/// The loop is closed in friction ratio, in front of the inverse map, so that its gain is near 1 at
/// every operating point. All ratios on base 2.
///
/// A changed target takes the delay of shaper, drive and sensor until the measured ratio shows it.
/// The reference is the expected reading meanwhile: the target of `delay_periods` ago, behind a lag
/// like the sensor's. It leaves out shaper and contact within that delay. So a change above
/// small_change() also holds the integral for hold_periods. The next such hold begins at least
/// rest_periods later, so that a target which keeps changing does not switch feedback off.
/// Anti-windup by conditional integration, see accept() (Åström 1995, ../README.md).
///
/// @tparam MaxDelay  largest delay_periods, >= 1; the delay line holds as many targets.
template <class ScalarT, int MaxDelay>
class IntegralRegulator {
 public:
  using Scalar = ScalarT;
  static constexpr PartName part_name{"feedback/integral_regulator", "IntegralRegulator"};
  struct Parameters {
    Scalar gain;                 ///< per carrier period
    Scalar keep;                 ///< of the reference's lag, per carrier period; in [0, 1)
    std::uint16_t hold_periods;  ///< at least delay_periods
    std::uint16_t rest_periods;  ///< between the beginnings of two holds for a changed target
    std::uint8_t delay_periods;  ///< 1 … MaxDelay

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("gain", self.gain);
      visit("keep", self.keep);
      visit("hold_periods", self.hold_periods);
      visit("rest_periods", self.rest_periods);
      visit("delay_periods", self.delay_periods);
    }
  };

  /// A friction ratio of 1/256, on base 2.
  static constexpr Scalar small_change() { return numeric::from_real<Scalar>(1.0 / 512.0); }

  static constexpr void scale_gain(Parameters& parameters, Scalar factor) {
    parameters.gain *= factor;
  }

  explicit IntegralRegulator(const Parameters& parameters) : parameters_(parameters) {}

  /// @param target  from here on
  void restart(Scalar target) {
    integral_ = {};
    for (Scalar& past : past_) {
      past = target;
    }
    reference_ = target;
    rest_ = 0;
    hold();
  }

  /// Holds the integral for the next `hold_periods` calls of propose().
  void hold() { held_ = parameters_.hold_periods; }

  /// @param change  from the target before to the new one
  /// @return whether it holds the integral
  bool target_changes(Scalar change) {
    if (rest_ == 0 && small_change() < numeric::abs(change)) {
      rest_ = parameters_.rest_periods;
      hold();
      return true;
    }
    return false;
  }

  /// A better known friction force. In terms of the old force the target was another ratio; the
  /// integral gives up what it had corrected for the difference.
  /// @param target   friction ratio
  /// @param reading  the target in terms of the old force
  void shift(Scalar target, Scalar reading) {
    integral_ += numeric::accumulate(target - reading);
    hold();
  }

  /// What a ScalingRegulator adds.
  template <class VelocityOf>
  static constexpr void learn_scale(const VelocityOf& /*velocity_of*/) {}
  static constexpr Scalar scaled(Scalar velocity) { return velocity; }
  static constexpr Scalar implied(Scalar ratio) { return ratio; }

  /// Commanded ratio, with the new error counted in; the integral stays as it is before accept().
  Scalar propose(Scalar target, Scalar measured) {
    const Scalar past = delayed(target);
    reference_ = past + numeric::rough_product(parameters_.keep, reference_ - past);
    error_ = numeric::observe<signal::RatioError>(reference_ - measured);
    proposed_ =
        held_ == 0 ? integral_ + numeric::accumulated_product(parameters_.gain, error_) : integral_;
    return numeric::observe<signal::CommandedRatio>(
        numeric::clamp_positive(target + numeric::rounded<Scalar>(proposed_), whole_ratio<Scalar>));
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
    if (numeric::likely(held_ == 0 && rest_ == 0)) {
      return;
    }
    held_ = static_cast<std::uint16_t>(held_ - (held_ > 0 ? 1 : 0));
    rest_ = static_cast<std::uint16_t>(rest_ - (rest_ > 0 ? 1 : 0));
  }

 protected:
  /// Reference less measured ratio, of the last proposal.
  Scalar error() const { return error_; }
  bool held() const { return held_ != 0; }
  Scalar gain() const { return parameters_.gain; }
  /// From the next proposal on.
  void set_gain(Scalar gain) { parameters_.gain = gain; }

 private:
  /// The target of delay_periods ago; this one takes its place.
  Scalar delayed(Scalar target) {
    if constexpr (MaxDelay <= 4) {
      return shifted(target);
    } else {
      const Scalar before = past_[place_];
      past_[place_] = target;
      place_ = static_cast<std::uint8_t>(place_ + 1 < parameters_.delay_periods ? place_ + 1 : 0);
      return before;
    }
  }

  /// The same, the oldest target first: quicker where there are few.
  Scalar shifted(Scalar target) {
    const Scalar before = past_[MaxDelay - parameters_.delay_periods];
    for (int i = 1; i < MaxDelay; ++i) {
      past_[i - 1] = past_[i];
    }
    past_[MaxDelay - 1] = target;
    return before;
  }

  Parameters parameters_;
  numeric::Accumulator<Scalar> integral_{};
  numeric::Accumulator<Scalar> proposed_{};
  Scalar reference_{};
  Scalar error_{};
  // No std::array: with it a compiler forgets the parameters at each store to a place that varies.
  Scalar past_[MaxDelay]{};
  std::uint16_t held_ = 0;
  std::uint16_t rest_ = 0;
  std::uint8_t place_ = 0;  ///< of the oldest target
};

}  // namespace sonoglide::control
