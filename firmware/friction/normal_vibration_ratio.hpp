/// Friction-ratio map of a Coulomb contact with springs that vibrates normally to the surface.
#pragma once

#include <limits>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/float_sqrt.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::friction {

namespace normal_vibration_ratio_detail {

/// The root x in (2 acos s, 2 pi] of the limit above the force,
///   h(x) = c (1 - cos x) - s (x - sin x),  c = sqrt(1 - s^2).
/// Half of the digits are enough, because the reduction is stationary there. h falls through the
/// root.
template <class Float>
Float sticking_phase(Float s, Float c) {
  constexpr Float accuracy = numeric::power_of_two<Float>(-std::numeric_limits<Float>::digits / 2);
  Float low = Float(2) * numeric::acos(s);
  Float high = numeric::from_real<Float>(numeric::two_pi);
  Float x = numeric::half(low + high);
  while (low < x && x < high) {
    const Float sine = numeric::sin(x);
    const Float half_sine = numeric::sin(numeric::half(x));
    const Float versine = Float(2) * half_sine * half_sine;
    const Float above = c * versine - s * (x - sine);
    (above > Float(0) ? low : high) = x;
    const Float newton = x - above / (c * sine - s * versine);
    const bool inside = low < newton && newton < high;
    if (inside && numeric::abs(newton - x) <= accuracy * x) {
      return newton;
    }
    x = inside ? newton : numeric::half(low + high);
  }
  return x;
}

}  // namespace normal_vibration_ratio_detail

/// Friction ratio of a contact pulled steadily while its indentation vibrates, steady state.
///
/// Indentation u + A cos(omega t), normal spring kz: the limit of friction is
/// mu kz (u + A cos omega t). The tangential spring kx is stretched at Vt. The slider slips while
/// the limit falls or rises more slowly than kx Vt, and sticks from then, through the phase x,
/// until it meets the limit again:
///   rho = 1 - alpha Psi(s) for s < 1, else 1,
///   2 pi Psi = c (x - sin x) - s (x^2 / 2 + cos x - 1),  c = sqrt(1 - s^2).
/// The published fit Psi = 3/4 (1 - s)^2 + 1/4 (1 - s)^4 lies above this by at most 0.015 (tested).
///
/// @param amplitude_ratio  alpha = A/u [-], in [0, 1]: beyond 1 the contact opens.
/// @param velocity_ratio   s = Vt/Vc [-], Vc = (mu kz/kx) omega A the speed from which the contact
///                         never sticks and nothing is gained; |s| is used. beta of the source is
///                         2 pi s.
/// @return mean(F)/(mu kz u) [-] in [0, 1].
/// Error <= 1e-14 in double, 1e-6 in float (tested against quadrature in long double).
/// Limits: 1 - alpha as s -> 0, the least normal force, whatever the springs; 1 from s = 1 on.
/// Not modelled: a contact that opens, inertia, a pull that yields, Hertzian springs.
/// Source: model of Popov 2020 (README.md), equations (17), (33) and (37); the integral is exact.
template <class Float>
Float normal_vibration_ratio(Float amplitude_ratio, Float velocity_ratio) {
  const Float s = numeric::abs(velocity_ratio);
  if (!(s < Float(1))) {
    return Float(1);
  }
  const Float c = numeric::sqrt((Float(1) - s) * (Float(1) + s));
  const Float x = normal_vibration_ratio_detail::sticking_phase(s, c);
  const Float half_sine = numeric::sin(numeric::half(x));
  const Float reduction =
      c * (x - numeric::sin(x)) - s * (numeric::half(x * x) - Float(2) * half_sine * half_sine);
  constexpr Float per_turn = numeric::from_real<Float>(1.0 / numeric::two_pi);
  return Float(1) - amplitude_ratio * (per_turn * reduction);
}

}  // namespace sonoglide::friction
