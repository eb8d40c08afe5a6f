/// What the controller answers once per carrier period.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/control/interface/ratio.hpp"

namespace sonoglide::control {

enum class State : std::uint8_t {
  off,          ///< not started, or stopped; drive zero
  calibrating,  ///< drive zero, the undriven friction force is being learnt
  running,
  limited,     ///< running, and the limit named in the command is active
  fault,       ///< drive zero until an explicit restart; the cause is kept
  relearning,  ///< the drive pauses, or comes back from a pause, to learn the friction force anew
};

/// Whether a controller answers its samples.
constexpr bool runs(State state) {
  // & and not &&: the compiler merges both comparisons into one.
  return (state != State::off) & (state != State::fault);
}

/// Whether a drive acts for the target, as far as a limit lets it.
constexpr bool drives(State state) {
  return state == State::running || state == State::limited;
}

/// What keeps the friction ratio from its target; the controller runs on.
enum class Limit : std::uint8_t {
  none = 0,
  actuator,     ///< the drive would have to leave [0, its limit], or a lower ceiling set to it
  slew,         ///< the drive amplitude may not change faster
  speed_floor,  ///< sliding slower than the stated floor: the ratio is undefined; the drive is held
                ///< for the stated time and then taken to zero
  ratio_end,    ///< the commanded ratio stands at 1, the weakest drive of the map
  mismatch,     ///< settled, but the friction force is not the nominal one: the true ratio is off
  not_settling,  ///< outside its band for longer than the stated time; see Settling for why
  bad_sample,    ///< the sample was unusable, the last request stands
  voltage,       ///< as actuator, of a resonant drive: its amplitude stands at the largest voltage
  current,       ///< the amplitude stands at the largest current
  frequency_range,   ///< the resonance seems to lie at an end of the frequency range, or beyond
  velocity_at_rail,  ///< sliding as fast as the largest vibration, or a velocity converter that
                     ///< stands at its end; the drive is held as below the speed floor
  contact_lost,      ///< a normal vibration opens the contact; only a simulation sees it
  bias,              ///< the bias force stands at an end of its range
  self_excited,  ///< falling friction feeds an oscillation under the drive that the target takes;
                 ///< only a simulation sees it
};

inline constexpr std::size_t limit_count = 15;

/// How the measured ratio stands to its target.
enum class Settling : std::uint8_t {
  pending = 0,  ///< nothing to be said yet
  settled,      ///< in its band: commanded over target is nominal over true friction
  // Why the limit not_settling is active:
  ringing,  ///< the ratio leaves its band on both sides: a natural mode, or a limit cycle
  offset,   ///< it stays on one side: the drive does not act as believed, or feedback is off
  clamped,  ///< the command stood at an end of its range meanwhile
};

/// Why the drive was switched off.
enum class Fault : std::uint8_t {
  none = 0,
  measurement_not_finite = 16,
  measurement_missing,
  measurement_saturated,
  measurement_stuck,        ///< the reading did not follow the command
  friction_not_learnt,      ///< too small a friction force, learnt or configured
  measurement_implausible,  ///< a ratio that no contact has, or friction that pulls: wired
                            ///< backwards
  vibration_missing,        ///< no fresh vibration sample, or none that shows the drive
  vibration_saturated,      ///< the vibration converter stood at a rail
  resonance_lost,  ///< the vibration does not follow the drive as that of a resonator would
  velocity_stuck,  ///< friction has come to pull while the velocity stood still to the code
};

/// What the drive is asked for.
template <class Scalar>
struct Request {
  Scalar amplitude;  ///< base: the largest; or a vibration velocity
  Limit limit;       ///< that keeps it from being another
};

template <class Scalar>
struct DriveCommand {
  Scalar amplitude;  ///< base: the actuator's limit; in [0, 1]
  /// Friction ratio, target and feedback together, base 2; over the target it is nominal over true
  /// friction force, once settled. 0 from a controller that feels the vibration in the friction: it
  /// sees no more than whether the two forces agree.
  Scalar commanded_ratio;
  State state;
  Limit limit;
  Fault fault;
  Settling settling;
};

/// Drive zero, at a commanded ratio of 1.
template <class Scalar>
constexpr DriveCommand<Scalar> no_drive(State state, Limit limit, Fault fault) {
  return {Scalar{}, whole_ratio<Scalar>, state, limit, fault, Settling::pending};
}

/// Of a unit that observes the vibration. At resonance its amplitude is in [-1, 1]: below 0 the
/// phase is turned by π.
template <class Scalar>
struct ResonantCommand : DriveCommand<Scalar> {
  std::int32_t frequency = 0;  ///< steps of the frequency word from the start
};

/// Of a unit that damps a slow natural mode by a force that is constant over a carrier period.
template <class Scalar>
struct BiasedCommand : DriveCommand<Scalar> {
  Scalar bias{};  ///< base: its limit; in [-1, 1], along the velocity of the vibration
};

}  // namespace sonoglide::control
