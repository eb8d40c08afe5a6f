/// The words by which states, limits and faults are named to people.
#pragma once

#include "firmware/control/drive_command.hpp"

namespace sonoglide::control {

constexpr const char* name(State state) {
  switch (state) {
    case State::off:
      return "off";
    case State::calibrating:
      return "calibrating";
    case State::running:
      return "running";
    case State::limited:
      return "limited";
    case State::fault:
      break;
  }
  return "fault";
}

constexpr const char* name(Limit limit) {
  switch (limit) {
    case Limit::actuator:
      return "actuator";
    case Limit::slew:
      return "slew";
    case Limit::speed_floor:
      return "speed_floor";
    case Limit::none:
      break;
  }
  return "none";
}

constexpr const char* name(Fault fault) {
  switch (fault) {
    case Fault::measurement_not_finite:
      return "measurement_not_finite";
    case Fault::measurement_missing:
      return "measurement_missing";
    case Fault::measurement_saturated:
      return "measurement_saturated";
    case Fault::measurement_stuck:
      return "measurement_stuck";
    case Fault::friction_not_learnt:
      return "friction_not_learnt";
    case Fault::none:
      break;
  }
  return "none";
}

}  // namespace sonoglide::control
