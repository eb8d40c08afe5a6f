/// The undriven friction force Fc, by which measured forces are divided.
#pragma once

#include "firmware/control/signals.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Fc held so that a measured force becomes a friction ratio by one multiplication and a shift.
/// Forces: base the sensor's full scale. Ratios: base 2, one bit of headroom above ρ = 1.
template <class Scalar>
class FrictionLevel {
 public:
  /// @param friction_force  Fc, at least smallest().
  explicit FrictionLevel(Scalar friction_force)
      : level_(numeric::split(friction_force)),
        quarter_inverse_(numeric::from_real<Scalar>(0.25) / level_.mantissa) {}

  /// Smallest usable Fc: 2^-10 of the force full scale.
  static constexpr Scalar smallest() { return numeric::from_real<Scalar>(1.0 / 1024.0); }

  /// F/Fc on base 2; saturates outside ±2 in fixed point.
  Scalar half_ratio(Scalar force) const {
    return numeric::observe<signal::MeasuredRatio>(
        numeric::rounded<Scalar>(numeric::scale_by_power_of_two(
            numeric::accumulated_product(force, quarter_inverse_), 1 - level_.exponent)));
  }

  const numeric::Split<Scalar>& level() const { return level_; }

 private:
  numeric::Split<Scalar> level_;
  Scalar quarter_inverse_;  ///< 1/(4·mantissa), in (1/4, 1/2]
};

}  // namespace sonoglide::control
