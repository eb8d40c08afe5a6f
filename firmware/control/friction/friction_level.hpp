/// The undriven friction force Fc, by which measured forces are divided.
#pragma once

#include <type_traits>

#include "firmware/control/interface/ratio.hpp"
#include "firmware/control/interface/signals.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/word.hpp"

namespace sonoglide::control {

/// Fc, held so that one multiplication, in fixed point with a shift, makes a friction ratio of a
/// measured force.
/// Forces: base the sensor's full scale. Ratios: base 2, one bit of headroom above ρ = 1.
template <class Scalar>
class FrictionLevel {
 public:
  /// @param friction_force  Fc, at least smallest().
  explicit FrictionLevel(Scalar friction_force)
      : level_(numeric::floating(friction_force)), inverse_(inverse_of(level_)) {}

  /// Smallest usable Fc: 2^-10 of the force full scale.
  static constexpr Scalar smallest() { return numeric::from_real<Scalar>(1.0 / 1024.0); }

  /// F/Fc on base 2; saturates outside ±2 in fixed point.
  Scalar half_ratio(Scalar force) const {
    if constexpr (std::is_same_v<numeric::Accumulator<Scalar>, Scalar> &&
                  numeric::is_fixed_point_v<Scalar>) {
      return numeric::observe<signal::MeasuredRatio>(numeric::raised(
          Scalar::from_raw(numeric::rounded_q31_product(force.raw(), inverse_.raw())),
          1 - level_.exponent));
    } else if constexpr (numeric::is_fixed_point_v<Scalar>) {
      return numeric::observe<signal::MeasuredRatio>(
          numeric::rounded<Scalar>(numeric::scale_by_power_of_two(
              numeric::accumulated_product(force, inverse_), 1 - level_.exponent)));
    } else {
      return force * inverse_;
    }
  }

  const numeric::Floating<Scalar>& level() const { return level_; }

  /// Fc.
  Scalar force() const {
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      return numeric::scale_by_power_of_two(level_.mantissa, level_.exponent);
    } else {
      return level_;
    }
  }

  /// Of a ratio in [0, 1/2].
  Scalar force_at(Scalar half_ratio) const {
    return is_whole(half_ratio) ? force() : numeric::twice(half_ratio) * force();
  }

 private:
  static Scalar inverse_of(const numeric::Floating<Scalar>& level) {
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      return numeric::from_real<Scalar>(0.25) / level.mantissa;
    } else {
      return Scalar{0.5} / level;
    }
  }

  numeric::Floating<Scalar> level_;
  Scalar inverse_;  ///< 1/(2 Fc); in fixed point 1/(4·mantissa), in (1/4, 1/2]
};

}  // namespace sonoglide::control
