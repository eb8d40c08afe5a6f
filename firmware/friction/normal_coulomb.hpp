/// Dry friction of a contact with springs that vibrates normally to the surface.
#pragma once

#include <cstddef>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// A slider that holds up to mu N(t), pulled at Vt through the tangential stiffness of its contact:
///
///              [ vibrating mass ]  y
///                     | kz
///     Vt --/\/\/-- [slider mu N] ------ surface
///            kx
///
///   N / N0 = (1 + nu y)_+,  d phi / d tau = kappa r while |phi| < N / N0,  else |phi| = N / N0.
///
/// phi = F / (mu N0); y > 0 is towards the surface. The slider slips while the limit falls, or
/// rises more slowly than the spring is loaded, and sticks from then until it meets the limit
/// again. Where the contact opens, phi = 0. In SI units nu = kz L / N0, kappa = kx L / (mu N0).
/// Passive: the contact stores phi^2 / (2 kappa), and slip only takes energy; the work of the pull
/// is never less than minus the stored energy.
/// Under y = sin tau, for nu <= 1, the mean of phi is normal_vibration_ratio(nu, kappa r / nu).
/// Not modelled: friction that acts back on the vibration; the stiffness kz in the oscillator,
/// whose spring has to include it, and its loss where the contact opens; impact; Hertzian springs.
/// What the members mean is listed in friction/law.hpp.
/// Source: Popov 2020 (README.md).
template <class Number>
struct NormalCoulomb {
  using Scalar = Number;
  static constexpr Vibration vibration = Vibration::normal;
  static constexpr bool reverses = false;
  static constexpr bool varies = true;
  static constexpr bool sticks = false;
  static constexpr bool rate_independent = false;
  static constexpr bool remembers = false;
  static constexpr bool has_corners = true;

  Scalar contact_stiffness = Scalar(1);  ///< kappa = kx L / (mu N0) [-], > 0
  Scalar normal_stiffness = Scalar(1);   ///< nu = kz L / N0 [-], > 0

  /// N / N0, negative where the contact is open by so much.
  Scalar pressure(Scalar displacement) const { return Scalar(1) + normal_stiffness * displacement; }
  /// The largest |phi|.
  Scalar limit(Scalar displacement) const {
    return numeric::max(Scalar(0), pressure(displacement));
  }

  /// What the oscillator feels of the friction: nothing.
  template <std::size_t Order>
  struct Series {
    Series(const NormalCoulomb& /*law*/, Scalar /*direction*/, Scalar /*friction*/) {}

    template <std::size_t N, class Travel>
    Scalar coefficient(const Travel& /*travel*/, Scalar /*unit*/) const {
      return Scalar(0);
    }
  };
};

}  // namespace sonoglide::friction
