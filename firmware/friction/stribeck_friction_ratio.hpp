/// Averaged characteristic of a cubic Stribeck contact.
#pragma once

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Mean friction of a cubic Stribeck contact under prescribed sinusoidal tangential vibration:
///   rho = C(r) - a r + b (r^3 + 3/2 r),  C the friction ratio of Coulomb.
///
/// The mean of V^3 = (Vt + v cos)^3 is Vt^3 + 3/2 Vt v^2. Where rho rises with r the mean friction
/// damps: vibration stops the stick-slip that falling friction causes.
///
/// @param velocity_ratio  r = Vt / v [-], v the peak vibration velocity.
/// @param fall  a = alpha v / mu_s [-].
/// @param rise  b = beta v^3 / mu_s [-].
/// @return mean(F) / (mu_s N) [-], of the sign of r.
/// Error: that of coulomb_friction_ratio and some roundings.
/// Source: Thomsen 1999 (README.md).
template <class Real>
Real stribeck_friction_ratio(Real velocity_ratio, Real fall, Real rise) {
  const Real r = velocity_ratio;
  const Real dry = numeric::sign(r) * coulomb_friction_ratio(r);
  return dry - r * (fall - rise * (r * r + Real(1.5)));
}

}  // namespace sonoglide::friction
