/// How a friction law is coupled to the oscillator.
#pragma once

#include "firmware/friction/none.hpp"
#include "firmware/friction/vibration.hpp"

namespace sonoglide::plant {

/// Vibration along the sliding: V = r + sigma v, friction force on the oscillator beta phi.
template <class Law, friction::Vibration = Law::vibration>
struct Contact {
  using Scalar = typename Law::Scalar;

  Law law{};
  Scalar friction_force = Scalar(0);  ///< beta = Fc / (m L omega^2) [-], >= 0
  Scalar vibration_sign = Scalar(1);  ///< sigma: +1 dissipative, -1 as the paper prints it

  Scalar side() const { return vibration_sign; }
  Scalar contact_velocity(Scalar sliding_velocity, Scalar velocity) const {
    return sliding_velocity + vibration_sign * velocity;
  }
  /// Velocity along the contact's path, and the part of it that the sliding contributes.
  Scalar path_velocity(Scalar sliding_velocity, Scalar velocity) const {
    return contact_velocity(sliding_velocity, velocity);
  }
  Scalar path_share(Scalar sliding_velocity) const { return sliding_velocity; }
  /// The velocity dy / d tau at which V = 0.
  Scalar resting_velocity(Scalar sliding_velocity) const {
    return -vibration_sign * sliding_velocity;
  }
  Scalar contact_force(Scalar friction) const { return friction_force * friction; }
  /// The friction on the oscillator, in Fc. `friction`, in Fc, acts along the sliding.
  Scalar friction_on_oscillator(Scalar /*sliding_velocity*/, Scalar /*velocity*/,
                                Scalar friction) const {
    return friction;
  }
  /// Power into the contact, in units of beta.
  Scalar friction_power(Scalar sliding_velocity, Scalar velocity, Scalar friction) const {
    return friction * contact_velocity(sliding_velocity, velocity);
  }
  /// Energy that leaves the oscillator, from an integral of phi times a sliding velocity.
  Scalar contact_work(Scalar integral) const { return vibration_sign * friction_force * integral; }
};

/// Vibration across the sliding. The contact's path is that of the oscillator; the slip is a
/// vector.
template <class Law>
struct Contact<Law, friction::Vibration::across> {
  using Scalar = typename Law::Scalar;
  using Slip = typename Law::Slip;

  Law law{};
  Scalar friction_force = Scalar(0);  ///< beta = Fc / (m L omega^2) [-], >= 0

  Scalar side() const { return Scalar(1); }
  Slip contact_velocity(Scalar sliding_velocity, Scalar velocity) const {
    return {sliding_velocity, velocity};
  }
  Scalar path_velocity(Scalar /*sliding_velocity*/, Scalar velocity) const { return velocity; }
  Scalar path_share(Scalar /*sliding_velocity*/) const { return Scalar(0); }
  Scalar contact_force(Scalar friction) const { return friction_force * friction; }
  Scalar friction_on_oscillator(Scalar sliding_velocity, Scalar velocity,
                                Scalar /*friction*/) const {
    return law.friction_across({sliding_velocity, velocity});
  }
  Scalar friction_power(Scalar sliding_velocity, Scalar velocity, Scalar /*friction*/) const {
    return Slip{sliding_velocity, velocity}.speed();
  }
  Scalar contact_work(Scalar integral) const { return friction_force * integral; }
};

/// Vibration normal to the surface: friction does not act on the oscillator.
template <class Law>
struct Contact<Law, friction::Vibration::normal> {
  using Scalar = typename Law::Scalar;

  Law law{};
  Scalar friction_force = Scalar(0);  ///< beta = mu N0 / (m L omega^2) [-], >= 0

  Scalar side() const { return Scalar(1); }
  Scalar path_velocity(Scalar /*sliding_velocity*/, Scalar velocity) const { return velocity; }
  Scalar path_share(Scalar /*sliding_velocity*/) const { return Scalar(0); }
  Scalar contact_force(Scalar /*friction*/) const { return Scalar(0); }
  Scalar contact_work(Scalar integral) const { return friction_force * integral; }
};

/// No contact: no parameters, and the compiler removes every term.
template <class Number>
struct Contact<friction::None<Number>, friction::Vibration::along> {
  using Scalar = Number;
  static constexpr friction::None<Number> law{};

  Scalar side() const { return Scalar(1); }
  Scalar contact_velocity(Scalar /*sliding_velocity*/, Scalar /*velocity*/) const {
    return Scalar(0);
  }
  Scalar path_velocity(Scalar /*sliding_velocity*/, Scalar /*velocity*/) const { return Scalar(0); }
  Scalar path_share(Scalar sliding_velocity) const { return sliding_velocity; }
  Scalar contact_force(Scalar /*friction*/) const { return Scalar(0); }
  Scalar friction_on_oscillator(Scalar /*sliding_velocity*/, Scalar /*velocity*/,
                                Scalar friction) const {
    return friction;
  }
  Scalar friction_power(Scalar /*sliding_velocity*/, Scalar /*velocity*/,
                        Scalar /*friction*/) const {
    return Scalar(0);
  }
  Scalar contact_work(Scalar /*integral*/) const { return Scalar(0); }
};

}  // namespace sonoglide::plant
