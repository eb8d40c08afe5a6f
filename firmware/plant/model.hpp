/// The oscillator with its friction contact, composed of types.
#pragma once

#include <type_traits>

#include "firmware/friction/law.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/contact.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

// The sliding velocity within an interval.

/// r = sliding_velocity + sliding_acceleration t, as plant::Interval says it.
struct LinearSliding {
  static constexpr bool varies = true;
  static constexpr bool moves = false;  ///< by its own inertia

  /// Change of r over a time, or over a group of times, in the unit of time of the acceleration.
  template <class Scalar, class Time>
  static constexpr Time change(Scalar acceleration, Time time) {
    return acceleration * time;
  }
};

/// r = sliding_velocity: an interval's sliding_acceleration is 0, and is not looked at.
struct ConstantSliding {
  static constexpr bool varies = false;
  static constexpr bool moves = false;

  /// The zero to add at no cost: x + -0 is x to a compiler, x + 0 is not.
  template <class Scalar, class Time>
  static constexpr Time change(Scalar /*acceleration*/, Time /*time*/) {
    return -Time{};
  }
};

/// r is a part of the state: a body of its own mass slides, see LoadedModel. An interval's
/// sliding_velocity and sliding_acceleration are then those of the pulled end of its spring.
struct MovingBody : LinearSliding {
  static constexpr bool moves = true;
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
/// DriveOf  NoDrive, CosineDrive, RampedCosineDrive or StraightDrive
/// SlidingOf  LinearSliding, or ConstantSliding where no interval has a sliding acceleration;
///            LoadedModel has MovingBody
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
  using Motion = std::conditional_t<Sliding::moves, LoadedState<Scalar>, State<Scalar>>;
  using PlantState = StateOf<Law, Motion>;

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

  /// Largest |V'| that friction at its limit holds at V = 0.
  Scalar holding_acceleration() const { return this->friction_force; }

  /// Kinetic energy and that of the spring, (v^2 + k y^2) / 2.
  Scalar stored_energy(const State<Scalar>& state) const {
    return (state.velocity * state.velocity + stiffness * state.displacement * state.displacement) /
           Scalar(2);
  }
};

/// The same with a load: the body that slides has a mass M of its own and is driven by a force, by a
/// damper and by a spring whose far end is pulled. The friction acts on it and, in the opposite
/// direction, on the oscillator:
///
///     y'' = a cos(tau) - d y' - k y - beta phi,      V = r + y',
///     r'  = fa(tau) - dl r - kl z - eps beta phi,    z' = r - vp(tau),   eps = m / M.
///
/// In SI units M dVt/dt = Fa - cl Vt - kl (xl - integral of vpull) - F, with xl the displacement of
/// the body and z the extension of the spring over L. fa, the force over M L omega^2, and vp, the
/// velocity of the pulled end over omega L, are linear in an interval (LoadedInterval). Without
/// springs, dampers and outer forces r / eps - y' is constant: the momentum of both masses, as y and
/// the sliding count in opposite directions.
template <class Law, class Damping, class DriveOf>
struct LoadedModel : Model<Law, Damping, DriveOf, MovingBody> {
  static_assert(Law::vibration == friction::Vibration::along,
                "a load needs friction along the vibration");

  using Scalar = typename Law::Scalar;

  Scalar mass_ratio = Scalar(0);      ///< eps = m / M [-], > 0
  Scalar load_damping = Scalar(0);    ///< dl = cl / (M omega) [-], >= 0
  Scalar load_stiffness = Scalar(0);  ///< kl / (M omega^2) [-], >= 0

  /// r' from the applied force, the damper and the spring.
  Scalar free_load_acceleration(Scalar force, Scalar sliding_velocity, Scalar extension) const {
    return force - load_damping * sliding_velocity - load_stiffness * extension;
  }
  /// What friction takes from r'.
  Scalar load_friction(Scalar friction) const { return mass_ratio * this->contact_force(friction); }
  Scalar holding_acceleration() const { return this->friction_force + load_friction(Scalar(1)); }

  /// Of the body and its spring, (r^2 + kl z^2) / (2 eps), in units of m L^2 omega^2.
  Scalar load_energy(const LoadedState<Scalar>& state) const {
    return (state.sliding_velocity * state.sliding_velocity +
            load_stiffness * state.extension * state.extension) /
           (Scalar(2) * mass_ratio);
  }
};

}  // namespace sonoglide::plant
