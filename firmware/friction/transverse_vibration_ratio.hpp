/// Friction-ratio map of a Coulomb contact that vibrates across the sliding.
#pragma once

#include "firmware/numeric/arithmetic_geometric_mean.hpp"
#include "firmware/numeric/float_sqrt.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Friction ratio of a Coulomb contact under prescribed sinusoidal vibration in the plane of the
/// contact, at right angles to the sliding.
///
/// Friction opposes the slip (Vt, v cos theta); the mean of its part along the sliding is that of
/// r / sqrt(r^2 + cos^2 theta),
///   rho = (2/pi) r / sqrt(1 + r^2) K(k),  k^2 = 1/(1 + r^2),
/// which by Gauss's formula for K is r / M(sqrt(1 + r^2), r), M the arithmetic-geometric mean.
///
/// @param velocity_ratio  r = Vt / v [-], v the peak vibration velocity; |r| is used.
/// @return mean(F)/Fc [-] in [0, 1].
/// Relative error <= 8 units in the last place of 1 (tested against Boost's ellint_1).
/// Limits: (2/pi) r ln(4/r) as r -> 0; 1 - 1/(4 r^2) as r -> infinity: it never reaches 1.
/// Not modelled: a contact that yields before it slides, whose ratio is the higher.
/// Source: Storck 2002 (README.md).
template <class Float>
Float transverse_vibration_ratio(Float velocity_ratio) {
  const Float r = numeric::abs(velocity_ratio);
  if (!(r > Float(0))) {
    return r;
  }
  // M is homogeneous: divided by r where the square of r may overflow.
  const Float part = r < Float(1) ? r : Float(1) / r;
  const Float hypotenuse = numeric::sqrt(Float(1) + part * part);
  return r < Float(1) ? r / numeric::arithmetic_geometric_mean(hypotenuse, r)
                      : Float(1) / numeric::arithmetic_geometric_mean(hypotenuse, Float(1));
}

}  // namespace sonoglide::friction
