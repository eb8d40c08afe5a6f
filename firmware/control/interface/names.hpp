/// The words by which states, limits, faults and the like are named to people.
#pragma once

#include "firmware/control/interface/drive_command.hpp"

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
    case State::relearning:
      return "relearning";
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
    case Limit::ratio_end:
      return "ratio_end";
    case Limit::mismatch:
      return "mismatch";
    case Limit::not_settling:
      return "not_settling";
    case Limit::bad_sample:
      return "bad_sample";
    case Limit::voltage:
      return "voltage";
    case Limit::current:
      return "current";
    case Limit::frequency_range:
      return "frequency_range";
    case Limit::velocity_at_rail:
      return "velocity_at_rail";
    case Limit::contact_lost:
      return "contact_lost";
    case Limit::bias:
      return "bias";
    case Limit::self_excited:
      return "self_excited";
    case Limit::none:
      break;
  }
  return "none";
}

constexpr const char* name(Settling settling) {
  switch (settling) {
    case Settling::settled:
      return "settled";
    case Settling::ringing:
      return "ringing";
    case Settling::offset:
      return "offset";
    case Settling::clamped:
      return "clamped";
    case Settling::pending:
      break;
  }
  return "pending";
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
    case Fault::measurement_implausible:
      return "measurement_implausible";
    case Fault::vibration_missing:
      return "vibration_missing";
    case Fault::vibration_saturated:
      return "vibration_saturated";
    case Fault::resonance_lost:
      return "resonance_lost";
    case Fault::velocity_stuck:
      return "velocity_stuck";
    case Fault::none:
      break;
  }
  return "none";
}

}  // namespace sonoglide::control
