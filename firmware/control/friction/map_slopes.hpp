/// Slopes of the logarithm of a friction ratio, from places of the inverse map.
#pragma once

#include "firmware/control/friction/half_logarithm.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// w = ∂ln ρ/∂ln v̂ and s = ∂ln ρ/∂ln Kt of ρ(Vt/v̂, κ), both in [-1, 0], at a ratio and a sliding speed.
/// Each function asks the map once, which is what a step of the controller has time for. Ratios on base 2.
template <class Scalar>
class MapSlopes {
 public:
  template <class Feedforward>
  void begin(Scalar ratio, const Feedforward& map, Scalar speed) {
    ratio_ = ratio;
    amplitude_ = map.amplitude(ratio, speed);
  }

  /// Half of w, by the difference to a ratio 1/64 beside on base 2.
  /// @return positive: both ratios are beyond the largest drive, there is no slope
  template <class Feedforward>
  Scalar of_velocity(const Feedforward& map, Scalar speed) {
    constexpr Scalar step = numeric::from_real<Scalar>(1.0 / 64.0);
    const bool up = ratio_ < one_half() - step;
    const Scalar beside = up ? ratio_ + step : ratio_ - step;
    const Scalar other = map.amplitude(beside, speed);
    const Scalar change =
        numeric::half_difference(up ? amplitude_ : other, up ? other : amplitude_);
    if (!(Scalar{} < change)) {
      return one_half();
    }
    const auto relative = numeric::quotient(numeric::floating(numeric::half_sum(amplitude_, other)),
                                            numeric::floating(change));
    const auto per_ratio = numeric::quotient(numeric::floating(numeric::half(step)),
                                             numeric::floating(numeric::half_sum(ratio_, beside)));
    return -numeric::limited_product(one_half(), numeric::product(relative, per_ratio));
  }

  /// Half of s, by the difference to a stiffer contact.
  /// @param map          inverse map
  /// @param speed        of the sliding
  /// @param of_velocity  that of the call before
  template <class Feedforward>
  Scalar of_stiffness(const Feedforward& map, Scalar speed, Scalar of_velocity) const {
    const Scalar stiffer = map.stiffer_amplitude(ratio_, speed);
    const Scalar change = numeric::max(Scalar{}, numeric::half_difference(amplitude_, stiffer));
    constexpr double per_log = 2.0 / 0.22314355131420976;  // ln 1.25
    constexpr Scalar factor = numeric::from_real<Scalar>(per_log / 16.0);
    const Scalar part = numeric::limited_product(
        change, numeric::rescaled(inverse_of(numeric::half_sum(amplitude_, stiffer)), 4));
    return numeric::rough_product(of_velocity, numeric::rough_product(factor, part));
  }

 private:
  static constexpr Scalar one_half() { return numeric::from_real<Scalar>(0.5); }

  Scalar ratio_{};
  Scalar amplitude_{};
};

}  // namespace sonoglide::control
