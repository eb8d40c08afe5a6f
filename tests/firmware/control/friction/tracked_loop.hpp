/// How far what a loop has learnt of its friction is from the truth.
#pragma once

#include <array>
#include <cmath>

#include "closed_loop.hpp"
#include "firmware/numeric/floating.hpp"

namespace sonoglide::control {

/// Of ln Fc, ln Kt and ln g.
using Vector = std::array<double, 3>;

/// A controller that takes the friction for 0.3 and names no mismatch.
inline Design trusting() {
  Design design;
  design.agreement = 0.0;
  design.implausible_periods = 60;
  design.friction_force = 0.3;
  return design;
}

template <class Scalar>
double real_of(const numeric::Floating<Scalar>& x) {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return std::ldexp(numeric::to_real(x.mantissa), x.exponent);
  } else {
    return numeric::to_real(x);
  }
}

/// Deviations that the controller tells.
template <class Loop>
Vector stated_deviations(const Loop& loop) {
  const auto variance = loop.controller.relearning().variance();
  return {std::sqrt(numeric::to_real(variance.force)),
          std::sqrt(numeric::to_real(variance.stiffness)),
          std::sqrt(numeric::to_real(variance.gain))};
}

/// In deviations of what the controller tells.
template <class Loop>
Vector deviations_off(const Loop& loop, const Design& design, const Contact& truth) {
  using Scalar = typename Loop::Scalar;
  const auto& tracking = loop.controller.relearning();
  const double gain = 1.0 / real_of<Scalar>(tracking.inverse_gain());
  const double stiffness = design.contact_force * real_of<Scalar>(tracking.contact()) / gain;
  const double force = numeric::to_real(loop.controller.friction_level().force());
  const Vector stated = stated_deviations(loop);
  return {std::log(force / truth.friction_force) / stated[0],
          std::log(stiffness / truth.contact_force) / stated[1],
          std::log(gain / truth.gain) / stated[2]};
}

}  // namespace sonoglide::control
