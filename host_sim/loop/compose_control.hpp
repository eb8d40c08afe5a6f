/// The controller of a scene, composed with every part that it may name.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <variant>

#include "firmware/control/controller.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/controller_parts.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/in_process_control.hpp"

namespace sonoglide::loop {
namespace compose {

using configure::ControlDesign;

/// The inverse map, but for friction that is learnt while driving.
template <class Scalar>
auto map_of(const ControlDesign& design) {
  return configure::choose<
      configure::Choice<control::CoulombFeedforward<Scalar>, control::DahlFeedforward<Scalar>,
                        control::TabulatedFeedforward<Scalar>>>(
      static_cast<std::size_t>(design.map));
}

/// Few scenes name a slew limit or relearning: they share compositions that have both, the one that
/// a scene does not name being wide open. So is a target that is a force. Every composition that is fed forward has a regulator, whose
/// gain is 0 where there is no feedback. The commands are those of the leanest parts, bit for bit.
template <class SlewT, class RelearningT>
struct Extras {
  using Slew = SlewT;
  using Relearning = RelearningT;
};
template <class Scalar>
using ExtrasChoice =
    configure::Choice<Extras<control::NoSlewLimit<Scalar>, control::NoRelearning<Scalar>>,
                      Extras<control::SlewLimit<Scalar>, control::PeriodicRelearning<Scalar>>>;

/// Few scenes have a law whose map is tabulated: they have both too.
template <class Scalar, class Feedforward, class Chosen>
using FewerExtras =
    std::conditional<std::is_same_v<Feedforward, control::TabulatedFeedforward<Scalar>>,
                     Extras<control::SlewLimit<Scalar>, control::PeriodicRelearning<Scalar>>,
                     Chosen>;

/// Relearning, a target force, the current limit of a resonant loop and its scale are wide open where a scene does
/// not name them.
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
          template <class, int> class Regulator = control::IntegralRegulator>
std::unique_ptr<ControlPort> make_observing_control(const ControlDesign& design) {
  const configure::ControllerParts<Scalar> parts(design);
  return std::visit(
      [&](auto friction, auto feedforward) -> std::unique_ptr<ControlPort> {
        using Friction = typename decltype(friction)::type;
        using Feedforward = typename decltype(feedforward)::type;
        if (design.senses_force) {
          using Feedback = Regulator<Scalar, configure::max_reference_delay>;
          return in_process<ObservedParts<Scalar, Friction, Feedforward, Feedback, Vibration,
                                          control::ForceSensor>>(design);
        }
        return in_process<
            ObservedParts<Scalar, control::TrustedFriction<Scalar>, Feedforward,
                          control::NoFeedback<Scalar>, Vibration, control::NoForceSensor>>(design);
      },
      parts.friction, map_of<Scalar>(design));
}

/// Relearning, a target force and the lead of a reading are wide open where a scene does not name them.
template <class Scalar, class Vibration>
std::unique_ptr<ControlPort> make_feeling_control(const ControlDesign& design) {
  const configure::ControllerParts<Scalar> parts(design);
  return std::visit(
      [&](auto friction, auto feedforward) -> std::unique_ptr<ControlPort> {
        using Parts =
            control::Parts<Scalar, typename decltype(friction)::type,
                           typename decltype(feedforward)::type, control::NoSlewLimit<Scalar>,
                           control::NoShaping<Scalar>, control::NoFeedback<Scalar>,
                           control::PeriodicRelearning<Scalar>, Vibration, control::ForceSensor,
                           control::ForceTarget<Scalar>>;
        return in_process<Parts>(design);
      },
      parts.friction, map_of<Scalar>(design));
}

/// A drive that is fed forward, with a bias. What is left out of other compositions is wide open where a scene
/// does not name it.
template <class Scalar>
std::unique_ptr<ControlPort> make_balanced_control(const ControlDesign& design) {
  const configure::ControllerParts<Scalar> parts(design);
  return std::visit(
      [&](auto friction, auto feedforward, auto shaper) -> std::unique_ptr<ControlPort> {
        using Parts =
            control::Parts<Scalar, typename decltype(friction)::type,
                           typename decltype(feedforward)::type, control::SlewLimit<Scalar>,
                           typename decltype(shaper)::type,
                           control::IntegralRegulator<Scalar, configure::max_reference_delay>,
                           control::PeriodicRelearning<Scalar>, control::BalancedFedForward<Scalar>,
                           control::ForceSensor, control::ForceTarget<Scalar>>;
        return in_process<Parts>(design);
      },
      parts.friction, map_of<Scalar>(design), parts.shaper);
}

/// Friction that is learnt while driving; the slew limit is wide open where a scene does not name it.
template <class Scalar>
std::unique_ptr<ControlPort> make_tracking_control(const ControlDesign& design) {
  return std::visit(
      [&](auto shaper) -> std::unique_ptr<ControlPort> {
        using Parts =
            control::Parts<Scalar, control::TrustedFriction<Scalar>,
                           control::TrackedDahlFeedforward<Scalar>, control::SlewLimit<Scalar>,
                           typename decltype(shaper)::type,
                           control::AdaptiveRegulator<Scalar, configure::max_reference_delay>,
                           control::FrictionTracking<Scalar>>;
        return std::make_unique<InProcessControl<Parts>>(design);
      },
      configure::ControllerParts<Scalar>(design).shaper);
}

}  // namespace compose

template <class Scalar>
std::unique_ptr<ControlPort> make_control(const configure::ControlDesign& design) {
  using namespace compose;
  if constexpr (configure::can_observe_vibration<Scalar>) {
    using configure::max_drive_delay;
    using configure::max_reading_delay;
    using Lagging = control::LaggingReading<Scalar>;
    using Current = control::CurrentLimit<Scalar>;
    switch (design.vibration_mode()) {
      case scene::VibrationMode::feedforward:
        if (design.bias) {
          return make_balanced_control<Scalar>(design);
        }
        break;
      case scene::VibrationMode::sensorless:
        return design.bias
                   ? make_feeling_control<Scalar, control::BiasedSensorlessVibration<
                                                      Scalar, max_reading_delay, Lagging>>(design)
                   : make_feeling_control<
                         Scalar, control::SensorlessVibration<Scalar, max_reading_delay, Lagging>>(
                         design);
      case scene::VibrationMode::damped:
        if (design.bias) {
          return make_observing_control<Scalar,
                                        control::BiasedDampedVibration<Scalar, max_drive_delay>>(
              design);
        }
        return make_observing_control<Scalar, control::DampedVibration<Scalar, max_drive_delay>>(
            design);
      case scene::VibrationMode::resonant:
        return make_observing_control<Scalar,
                                      control::ResonantVibration<Scalar, max_drive_delay, Current>,
                                      control::ScalingRegulator>(design);
    }
  }
  if constexpr (configure::can_track_friction<Scalar>) {
    if (design.tracks) {
      return make_tracking_control<Scalar>(design);
    }
  }
  const configure::ControllerParts<Scalar> parts(design);
  return std::visit(
      [&](auto friction, auto feedforward, auto shaper,
          auto extras) -> std::unique_ptr<ControlPort> {
        using Chosen = typename FewerExtras<Scalar, typename decltype(feedforward)::type,
                                            typename decltype(extras)::type>::type;
        using Parts =
            control::Parts<Scalar, typename decltype(friction)::type,
                           typename decltype(feedforward)::type, typename Chosen::Slew,
                           typename decltype(shaper)::type,
                           control::AdaptiveRegulator<Scalar, configure::max_reference_delay>,
                           typename Chosen::Relearning, control::FedForward<Scalar>,
                           control::ForceSensor, control::ForceTarget<Scalar>>;
        return std::make_unique<InProcessControl<Parts>>(design);
      },
      parts.friction, map_of<Scalar>(design), parts.shaper,
      configure::choose<ExtrasChoice<Scalar>>(design.slew_limited || design.relearns));
}

}  // namespace sonoglide::loop
