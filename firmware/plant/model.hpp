/// The oscillator with its friction contact, composed of types.
#pragma once

#include "firmware/friction/law.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/contact.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

// The sliding velocity within an interval.

/// r = sliding_velocity + sliding_acceleration t, as plant::Interval says it.
struct LinearSliding {
  static constexpr bool varies = true;

  /// Change of r over a time, or over a group of times, in the unit of time of the acceleration.
  template <class Scalar, class Time>
  static constexpr Time change(Scalar acceleration, Time time) {
    return acceleration * time;
  }
};

/// r = sliding_velocity: an interval's sliding_acceleration is 0, and is not looked at.
struct ConstantSliding {
  static constexpr bool varies = false;

  /// The zero to add at no cost: x + -0 is x to a compiler, x + 0 is not.
  template <class Scalar, class Time>
  static constexpr Time change(Scalar /*acceleration*/, Time /*time*/) {
    return -Time{};
  }
};

/// No damping, and no member for it.
template <class Scalar>
struct Undamped {
  Scalar damping_force(Scalar /*velocity*/) const { return Scalar(0); }
};

/// Damping force d v on the oscillator.
template <class Scalar>
struct Damped {
  Scalar damping = Scalar(0);  ///< d = c / (m omega) [-]

  Scalar damping_force(Scalar velocity) const { return damping * velocity; }
};

/// y'' = a cos(tau) - d y' - k y - beta phi, in units of length L, time 1 / omega and force m L
/// omega^2; phi = F / Fc, of the friction on the oscillator.
///
/// Law      friction::None, or another law of friction/ (law.hpp lists what a law offers)
/// Damping  Undamped or Damped
/// DriveOf  NoDrive, CosineDrive, RampedCosineDrive, RampDrive or LevelDrive
/// SlidingOf  LinearSliding, or ConstantSliding where no interval has a sliding acceleration
/// What is not named has no member: the parameters of a law and of the damping are its own.
/// Aggregate: Model{{law, friction_force, vibration_sign}, {damping}, stiffness}, without the sign
/// where the vibration is not along the sliding.
template <class Law, class Damping, class DriveOf, class SlidingOf = LinearSliding>
struct Model : Contact<Law>, Damping {
  static_assert(friction::check_law<Law>());

  using Scalar = typename Law::Scalar;
  using FrictionLaw = Law;
  using Drive = DriveOf;
  using Sliding = SlidingOf;

  Scalar stiffness = Scalar(0);  ///< k = Ks / (m omega^2) [-], any sign, 0 allowed

  Scalar acceleration(Scalar drive, const State<Scalar>& state) const {
    return drive - this->damping_force(state.velocity) - stiffness * state.displacement -
           this->contact_force(state.friction);
  }

  /// Sum of the moduli of the terms of y''; its rounding error is relative to this.
  Scalar force_moduli(Scalar drive, const State<Scalar>& state) const {
    return drive + numeric::abs(this->damping_force(state.velocity)) +
           numeric::abs(stiffness * state.displacement) +
           numeric::abs(this->contact_force(state.friction));
  }

  /// Kinetic energy and that of the spring, (v^2 + k y^2) / 2.
  Scalar stored_energy(const State<Scalar>& state) const {
    return (state.velocity * state.velocity + stiffness * state.displacement * state.displacement) /
           Scalar(2);
  }
};

}  // namespace sonoglide::plant
