/// The controller of a scene, composed with every part that it may name.
#pragma once

#include <memory>
#include <type_traits>
#include <variant>

#include "firmware/control/controller.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/controller_parts.hpp"
#include "host_sim/loop/control/compose_observed.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/control/in_process_control.hpp"

namespace sonoglide::loop {
namespace compose {

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
                           typename configure::RegulatorParts<Scalar>::ForeseenIntegral,
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
        using Parts = control::Parts<Scalar, control::TrustedFriction<Scalar>,
                                     control::TrackedDahlFeedforward<Scalar>,
                                     control::SlewLimit<Scalar>, typename decltype(shaper)::type,
                                     typename configure::RegulatorParts<Scalar>::ForeseenAdaptive,
                                     control::FrictionTracking<Scalar>>;
        return std::make_unique<InProcessControl<Parts>>(design);
      },
      configure::ControllerParts<Scalar>(design).shaper);
}

/// A drive that is fed forward, of a trusted or calibrated friction.
template <class Scalar>
std::unique_ptr<ControlPort> make_fed_forward_control(const ControlDesign& design) {
  const configure::ControllerParts<Scalar> parts(design);
  return std::visit(
      [&](auto friction, auto feedforward, auto shaper,
          auto extras) -> std::unique_ptr<ControlPort> {
        using Chosen = typename FewerExtras<Scalar, typename decltype(feedforward)::type,
                                            typename decltype(extras)::type>::type;
        using Parts = control::Parts<Scalar, typename decltype(friction)::type,
                                     typename decltype(feedforward)::type, typename Chosen::Slew,
                                     typename decltype(shaper)::type,
                                     typename configure::RegulatorParts<Scalar>::ForeseenAdaptive,
                                     typename Chosen::Relearning, control::FedForward<Scalar>,
                                     control::ForceSensor, control::ForceTarget<Scalar>>;
        return std::make_unique<InProcessControl<Parts>>(design);
      },
      parts.friction, map_of<Scalar>(design), parts.shaper,
      configure::choose<ExtrasChoice<Scalar>>(design.slew_limited || design.relearns));
}

}  // namespace compose

template <class Scalar>
std::unique_ptr<ControlPort> make_control(const configure::ControlDesign& design) {
  if constexpr (configure::can_observe_vibration<Scalar>) {
    if (design.vibration_mode() != scene::VibrationMode::feedforward) {
      return compose::make_observed_control<Scalar>(design);
    }
    if (design.bias) {
      return compose::make_balanced_control<Scalar>(design);
    }
  }
  if constexpr (configure::can_track_friction<Scalar>) {
    if (design.tracks) {
      return compose::make_tracking_control<Scalar>(design);
    }
  }
  return compose::make_fed_forward_control<Scalar>(design);
}

}  // namespace sonoglide::loop
