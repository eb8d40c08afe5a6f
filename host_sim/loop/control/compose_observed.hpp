/// The controllers of a scene that observe the vibration, composed with every part that it may name.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <variant>

#include "firmware/control/controller.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/controller_parts.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/control/in_process_control.hpp"

namespace sonoglide::loop::compose {

using configure::ControlDesign;

/// The inverse map, but for friction that is learnt while driving.
template <class Scalar>
auto map_of(const ControlDesign& design) {
  return configure::choose<
      configure::Choice<control::CoulombFeedforward<Scalar>, control::DahlFeedforward<Scalar>,
                        control::TabulatedFeedforward<Scalar>>>(
      static_cast<std::size_t>(design.map));
}

/// Relearning, a target force, the lead of a slow contact, the current limit of a resonant loop and its scale are wide
/// open where a scene does not need them.
template <class Scalar, class Friction, class Feedforward, class Regulator, class Vibration,
          class Force>
using ObservedParts = control::Parts<
    Scalar, Friction, Feedforward, control::NoSlewLimit<Scalar>, control::NoShaping<Scalar>,
    Regulator,
    std::conditional_t<Force::present, control::PeriodicRelearning<Scalar>,
                       control::NoRelearning<Scalar>>,
    Vibration, Force,
    std::conditional_t<Force::present, control::ForceTarget<Scalar>, control::RatioTarget<Scalar>>>;

template <class Scalar, class Vibration,
          class Regulator = typename configure::RegulatorParts<Scalar>::LedIntegral>
std::unique_ptr<ControlPort> make_observing_control(const ControlDesign& design) {
  const configure::ControllerParts<Scalar> parts(design);
  return std::visit(
      [&](auto friction, auto feedforward) -> std::unique_ptr<ControlPort> {
        using Friction = typename decltype(friction)::type;
        using Feedforward = typename decltype(feedforward)::type;
        if (design.senses_force) {
          return in_process<ObservedParts<Scalar, Friction, Feedforward, Regulator, Vibration,
                                          control::ForceSensor>>(design);
        }
        return in_process<
            ObservedParts<Scalar, control::TrustedFriction<Scalar>, Feedforward,
                          control::NoFeedback<Scalar>, Vibration, control::NoForceSensor>>(design);
      },
      parts.friction, map_of<Scalar>(design));
}

/// Relearning, a target force, the lead of a slow contact and that of a reading are wide open where a scene does not
/// need them.
template <class Scalar, class Vibration>
std::unique_ptr<ControlPort> make_feeling_control(const ControlDesign& design) {
  const configure::ControllerParts<Scalar> parts(design);
  return std::visit(
      [&](auto friction, auto feedforward) -> std::unique_ptr<ControlPort> {
        using Parts = control::Parts<
            Scalar, typename decltype(friction)::type, typename decltype(feedforward)::type,
            control::NoSlewLimit<Scalar>, control::NoShaping<Scalar>,
            typename configure::RegulatorParts<Scalar>::Lead, control::PeriodicRelearning<Scalar>,
            Vibration, control::ForceSensor, control::ForceTarget<Scalar>>;
        return in_process<Parts>(design);
      },
      parts.friction, map_of<Scalar>(design));
}

/// In a mode that observes the vibration.
template <class Scalar>
std::unique_ptr<ControlPort> make_observed_control(const ControlDesign& design) {
  using configure::max_drive_delay;
  using configure::max_reading_delay;
  const scene::VibrationMode mode = design.vibration_mode();
  if (mode == scene::VibrationMode::sensorless) {
    using Lagging = control::LaggingReading<Scalar>;
    return design.bias
               ? make_feeling_control<Scalar, control::BiasedSensorlessVibration<
                                                  Scalar, max_reading_delay, Lagging>>(design)
               : make_feeling_control<
                     Scalar, control::SensorlessVibration<Scalar, max_reading_delay, Lagging>>(
                     design);
  }
  if (mode == scene::VibrationMode::damped) {
    return design.bias
               ? make_observing_control<Scalar,
                                        control::BiasedDampedVibration<Scalar, max_drive_delay>>(
                     design)
               : make_observing_control<Scalar, control::DampedVibration<Scalar, max_drive_delay>>(
                     design);
  }
  using Current = control::CurrentLimit<Scalar>;
  return make_observing_control<Scalar,
                                control::ResonantVibration<Scalar, max_drive_delay, Current>,
                                typename configure::RegulatorParts<Scalar>::Scaling>(design);
}

}  // namespace sonoglide::loop::compose
