/// A contact without friction, and the list of what every friction law offers.
#pragma once

#include <cstddef>

#include "firmware/friction/vibration.hpp"

namespace sonoglide::friction {

/// No friction: phi = 0.
///
/// A law gives phi = F/Fc [-] in [-1, 1] in terms of the sliding velocity V = du/d tau. It offers:
///   vibration            which way the mass vibrates, seen from the sliding
///   reverses             phi depends on sgn V, so that an event solver stops where V changes sign
///   varies               phi changes between two reversals
///   sticks               V may stay zero while a friction force below Fc holds it there
///   rate_independent     between two reversals phi depends on the displacement alone
///   remembers            phi is not all that the contact knows of its past
///   has_corners          the slope d phi / du may jump between two reversals
///   friction(V, phi)     the friction that acts now, phi being its last value
///   rate(V, phi)         d phi / d tau, for step-by-step methods; 0 where V alone sets phi
///   series_unit(V, phi, tau)  time, at most tau, in which the power series is written: its
///                        coefficients stay moderate
/// A law that is rate independent:
///   Arc                  the law between two reversals, where sgn V = direction is constant:
///     coefficient<N>(travel, earlier)  N-th Taylor coefficient of phi in x = time / unit, from
///                          those of travel, du/dx, and of phi itself, below N
///     friction_after(du)   phi exactly, after the displacement du >= 0 along the direction
///     friction_along(du)   where it varies: the same at a group of lanes, for du from a rounding
///                          error below 0; absolute error 1e-9 (double), 5e-6 (float), where it has
///                          relaxed by less than a factor of e^6 1e-13 in double
///     work(du)             integral of phi V d tau exactly, over the same displacement
/// Another, in its place:
///   reach(V)             change of V over which a power series tells what is to come
///   Series<Order>        such a series, sgn V = direction being constant:
///     coefficient<N>(travel, unit)  N-th Taylor coefficient of phi in x = time / unit, from those
///                          of travel up to N
/// A law that remembers has a Memory, which takes the place of phi as an argument of friction, rate
/// and series_unit and is what rate gives the derivative of. It also offers:
///   largest_memory()     no motion takes |Memory| beyond it
///   memory_at(phi)       the Memory of a contact that has been loaded to phi for the first time
///   Series<Order>::memory(x)  the Memory at x; where rate independent,
///   Arc::memory_after(du)     the Memory after the displacement du
/// A law that vibrates across the sliding takes for V a Slip, along and across, and has
///   friction_across(V)   the friction on the oscillator, phi being that along the sliding
///   Series<Order>        of the friction across, from the coefficients of either velocity; it also
///                        has friction_along(n), the n-th coefficient of phi
/// A law that vibrates normally to the surface has a pressure and a limit of |phi| in terms of the
/// displacement y, and a spring in front of its slider: friction::NormalCoulomb.
/// Another law that has corners is rate independent and remembers; no rate is asked of it. It also
/// offers:
///   Arc::to_corner()     the displacement, along the direction, to the first of them, or infinity
template <class Number>
struct None {
  using Scalar = Number;
  static constexpr Vibration vibration = Vibration::along;
  static constexpr bool reverses = false;
  static constexpr bool varies = false;
  static constexpr bool sticks = false;
  static constexpr bool rate_independent = true;
  static constexpr bool remembers = false;
  static constexpr bool has_corners = false;

  Scalar friction(Scalar /*velocity*/, Scalar /*last_friction*/) const { return Scalar(0); }
  Scalar rate(Scalar /*velocity*/, Scalar /*friction*/) const { return Scalar(0); }
  Scalar series_unit(Scalar /*velocity*/, Scalar /*friction*/, Scalar longest) const {
    return longest;
  }

  struct Arc {
    Arc(const None& /*law*/, Scalar /*direction*/, Scalar /*friction*/) {}

    template <std::size_t N, class Travel, class Coefficients>
    Scalar coefficient(const Travel& /*travel*/, const Coefficients& /*earlier*/) const {
      return Scalar(0);
    }
    Scalar friction_after(Scalar /*displacement*/) const { return Scalar(0); }
    Scalar work(Scalar /*displacement*/) const { return Scalar(0); }
  };
};

}  // namespace sonoglide::friction
