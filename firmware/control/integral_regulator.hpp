/// Integral feedback on the friction ratio.
#pragma once

#include <cstdint>

#include "firmware/control/signals.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// commanded ratio = target + integral of (target − measured), in [0, 1].
///
/// The loop is closed in friction ratio, in front of the inverse map, so that its gain is near 1 at
/// every operating point. All ratios on base 2. While a command is still on its way through shaper,
/// plant and sensor (`hold_periods`) the error says nothing yet and the integral is held.
template <class Scalar>
class IntegralRegulator {
 public:
  struct Parameters {
    Scalar gain;  ///< per carrier period
    std::uint16_t hold_periods;
  };

  static constexpr void scale_gain(Parameters& parameters, Scalar factor) {
    parameters.gain *= factor;
  }

  explicit IntegralRegulator(const Parameters& parameters) : parameters_(parameters) {}

  void restart() {
    integral_ = {};
    hold();
  }

  /// Holds the integral for the next `hold_periods` calls of propose().
  void hold() { held_ = parameters_.hold_periods; }

  /// Commanded ratio, with the new error counted in; nothing is kept before accept().
  Scalar propose(Scalar target, Scalar measured) {
    error_ = numeric::observe<signal::RatioError>(target - measured);
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
  }

 private:
  Parameters parameters_;
  numeric::Accumulator<Scalar> integral_{};
  numeric::Accumulator<Scalar> proposed_{};
  Scalar error_{};
  std::uint16_t held_ = 0;
};

}  // namespace sonoglide::control
