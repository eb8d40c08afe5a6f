/// What the controller answers once per carrier period.
#pragma once

#include <cstdint>

namespace sonoglide::control {

enum class State : std::uint8_t {
  off,          ///< not started, or stopped; drive zero
  calibrating,  ///< drive zero, the undriven friction force is being learnt
  running,
  limited,  ///< running, and the limit named in the command is active
  fault,    ///< drive zero until an explicit restart; the cause is kept
};

/// What keeps the command from following the target; the controller runs on.
enum class Limit : std::uint8_t {
  none = 0,
  actuator,     ///< the drive would have to leave [0, its limit], or a lower ceiling set to it
  slew,         ///< the drive amplitude may not change faster
  speed_floor,  ///< sliding slower than the stated floor: the ratio is undefined, the drive is held
};

/// Why the drive was switched off.
enum class Fault : std::uint8_t {
  none = 0,
  measurement_not_finite = 16,
  measurement_missing,
  measurement_saturated,
  measurement_stuck,    ///< the reading did not follow the command
  friction_not_learnt,  ///< too small a friction force, learnt or configured
};

template <class Scalar>
struct DriveCommand {
  Scalar amplitude;  ///< base: the actuator's limit; in [0, 1]
  State state;
  Limit limit;
  Fault fault;
};

}  // namespace sonoglide::control
