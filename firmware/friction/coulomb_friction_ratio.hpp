/// Friction-ratio map of a Coulomb contact.
#pragma once

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Friction ratio of a Coulomb contact under prescribed sinusoidal tangential vibration:
///   ρ = (2/π) asin r for r < 1, else 1.
///
/// @param velocity_ratio  r = Vt / v̂ [-], v̂ the peak vibration velocity; |r| is used.
/// @return mean(F)/Fc [-] in [0, 1].
/// Error: that of numeric::asin_per_pi, doubled.
template <class Real>
Real coulomb_friction_ratio(Real velocity_ratio) {
  const Real r = numeric::abs(velocity_ratio);
  return r < Real(1) ? Real(2) * numeric::asin_per_pi(r) : Real(1);
}

}  // namespace sonoglide::friction
