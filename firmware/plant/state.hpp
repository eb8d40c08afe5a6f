/// State of the plant, the interval over which a solver advances it, and how equal steps cut it. All
/// dimensionless.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

/// Scales are the host's: length L, angular frequency omega, friction limit Fc.
template <class Scalar>
struct State {
  Scalar displacement = Scalar(0);  ///< y = x / L
  Scalar velocity = Scalar(0);      ///< dy / d tau, tau = omega t
  Scalar friction = Scalar(0);      ///< phi = F / Fc, in [-1, 1]
};

/// State of a plant on which a load slides: a body of its own mass (see LoadedModel).
template <class Scalar>
struct LoadedState : State<Scalar> {
  Scalar sliding_velocity = Scalar(0);  ///< r = Vt / (omega L)
  Scalar extension = Scalar(0);  ///< z of its spring: displacement of the body less that of the
                                 ///< pulled end, over L
};

/// State of a plant whose contact remembers more than its force.
template <class Law, class Motion = State<typename Law::Scalar>>
struct RememberingState : Motion {
  typename Law::Memory memory{};
};

/// State of a plant with this friction law, and with this motion of its masses.
template <class Law, class Motion = State<typename Law::Scalar>>
using StateOf = std::conditional_t<Law::remembers, RememberingState<Law, Motion>, Motion>;

/// What the law advances: phi, or its Memory.
template <class Scalar>
Scalar& contact_memory(State<Scalar>& state) {
  return state.friction;
}
template <class Scalar>
const Scalar& contact_memory(const State<Scalar>& state) {
  return state.friction;
}
template <class Law, class Motion>
typename Law::Memory& contact_memory(RememberingState<Law, Motion>& state) {
  return state.memory;
}
template <class Law, class Motion>
const typename Law::Memory& contact_memory(const RememberingState<Law, Motion>& state) {
  return state.memory;
}

/// False if any number of the motion is infinite or not a number.
template <class Scalar>
bool is_finite(const State<Scalar>& state) {
  return numeric::is_finite(state.displacement) && numeric::is_finite(state.velocity) &&
         numeric::is_finite(state.friction);
}
template <class Scalar>
bool is_finite(const LoadedState<Scalar>& state) {
  const State<Scalar>& oscillator = state;
  return is_finite(oscillator) && numeric::is_finite(state.sliding_velocity) &&
         numeric::is_finite(state.extension);
}

/// A stretch of time with one drive amplitude and a sliding velocity that is linear in time:
/// drive force a cos(phase_begin + t), r = sliding_velocity + sliding_acceleration t, t in
/// [0, duration]. The amplitude is a number, or what else the drive says (drive.hpp).
template <class Scalar, class Amplitude = Scalar>
struct Interval {
  Scalar phase_begin = Scalar(0);       ///< [0, 2 pi): the caller reduces it, or accuracy is lost
  Scalar duration = Scalar(0);          ///< >= 0, in units of 1 / omega
  Amplitude drive_amplitude{};          ///< a = A / (m L omega^2)
  Scalar sliding_velocity = Scalar(0);  ///< r = Vt / (omega L) at the beginning
  Scalar sliding_acceleration = Scalar(0);  ///< dr / d tau
};

/// The same for a plant with a load: sliding_velocity and sliding_acceleration are those of the pulled
/// end of its spring, and the force on the body is load_force + load_force_rate t.
template <class Scalar, class Amplitude = Scalar>
struct LoadedInterval : Interval<Scalar, Amplitude> {
  Scalar load_force = Scalar(0);       ///< Fa / (M L omega^2) at the beginning
  Scalar load_force_rate = Scalar(0);  ///< its derivative by tau
};

/// As a plant::Model takes it.
template <class Model>
using IntervalOf = std::conditional_t<
    Model::Sliding::moves,
    LoadedInterval<typename Model::Scalar,
                   typename Model::Drive::template Amplitude<typename Model::Scalar>>,
    Interval<typename Model::Scalar,
             typename Model::Drive::template Amplitude<typename Model::Scalar>>>;

/// The smallest number of equal steps no longer than longest_step. A number above `limit` is not
/// told exactly: it is given as limit + 1.
///
/// A step that fits a whole number of times to within 1e-5 of it counts as fitting.
template <class Scalar>
std::uint32_t fixed_step_count(Scalar duration, Scalar longest_step, std::uint32_t limit) {
  const Scalar steps = duration / longest_step * numeric::from_real<Scalar>(1.0 - 1e-5);
  if (!(steps <= static_cast<Scalar>(limit))) {
    return limit + 1;
  }
  const auto whole = static_cast<std::uint32_t>(steps);
  return steps > static_cast<Scalar>(whole) ? whole + 1 : whole;
}

}  // namespace sonoglide::plant
