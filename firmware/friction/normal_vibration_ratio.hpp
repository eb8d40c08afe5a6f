/// Friction-ratio map of a Coulomb contact with springs that vibrates normally to the surface.
#pragma once

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Friction ratio of a contact pulled steadily while its indentation vibrates.
///
/// Indentation u + A cos(omega t), normal spring kz: the limit of friction is
/// mu kz (u + A cos omega t). The tangential spring kx is stretched at Vt. It slides while the
/// limit falls or rises more slowly than kx Vt, and sticks from then until it meets the limit again:
///   rho = 1 - alpha Psi(s),  Psi = 3/4 (1 - s)^2 + 1/4 (1 - s)^4 for s < 1, else 0.
/// Psi is the published approximation: within 0.015 of the model, above it where both are not 0
/// (tested).
///
/// @param amplitude_ratio  alpha = A/u [-], in [0, 1]: beyond 1 the contact opens.
/// @param velocity_ratio   s = Vt/Vc [-], Vc = (mu kz/kx) omega A the speed from which the contact
///                         never sticks and nothing is gained; |s| is used. beta of the source is
///                         2 pi s.
/// @return mean(F)/(mu kz u) [-] in [0, 1].
/// Limits: 1 - alpha as s -> 0, the least normal force, whatever the springs; 1 from s = 1 on.
/// Not modelled: a contact that opens, inertia, a pull that yields, Hertzian springs.
/// Source: M. Popov, Frontiers in Mechanical Engineering 6 (2020) 69,
/// 10.3389/fmech.2020.00069, equations (17), (33) and (37).
template <class Real>
Real normal_vibration_ratio(Real amplitude_ratio, Real velocity_ratio) {
  const Real below = Real(1) - numeric::min(numeric::abs(velocity_ratio), Real(1));
  const Real square = below * below;
  return Real(1) - amplitude_ratio * square * (Real(0.75) + Real(0.25) * square);
}

}  // namespace sonoglide::friction
