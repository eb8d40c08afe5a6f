/// How a friction law is coupled to the oscillator.
#pragma once

#include "firmware/friction/none.hpp"

namespace sonoglide::plant {

/// Sliding velocity V = r + sigma v, friction force on the oscillator beta phi.
template <class Law>
struct Contact {
  using Scalar = typename Law::Scalar;

  Law law{};
  Scalar friction_force = Scalar(0);  ///< beta = Fc / (m L omega^2) [-], >= 0
  Scalar vibration_sign = Scalar(1);  ///< sigma: +1 dissipative, -1 as the paper prints it

  Scalar side() const { return vibration_sign; }
  Scalar contact_velocity(Scalar sliding_velocity, Scalar velocity) const {
    return sliding_velocity + vibration_sign * velocity;
  }
  /// The velocity dy / d tau at which V = 0.
  Scalar resting_velocity(Scalar sliding_velocity) const {
    return -vibration_sign * sliding_velocity;
  }
  Scalar contact_force(Scalar friction) const { return friction_force * friction; }
  /// Energy that leaves the oscillator, from an integral of phi times a sliding velocity.
  Scalar contact_work(Scalar integral) const { return vibration_sign * friction_force * integral; }
};

/// Nothing touches: no parameters, and every term folds away.
template <class Number>
struct Contact<friction::None<Number>> {
  using Scalar = Number;
  static constexpr friction::None<Number> law{};

  Scalar side() const { return Scalar(1); }
  Scalar contact_velocity(Scalar /*sliding_velocity*/, Scalar /*velocity*/) const {
    return Scalar(0);
  }
  Scalar contact_force(Scalar /*friction*/) const { return Scalar(0); }
  Scalar contact_work(Scalar /*integral*/) const { return Scalar(0); }
};

}  // namespace sonoglide::plant
