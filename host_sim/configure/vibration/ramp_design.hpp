/// How a drive whose amplitude passes linearly from one carrier period to the next keeps the natural
/// mode quiet: by that alone, or with a notch.
#pragma once

#include <optional>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// How far the nominal natural frequency may be off, relative: by the tolerances of
/// stiffness and mass; without them 0.01, with which fewer steps of random loops failed to settle than with
/// 0 or 0.025, whether their stiffness was nominal or up to 5 % off. What [model_error] says is hidden
/// from a controller, and so from its design.
double assumed_frequency_range(const scene::Scene& scene);

/// The free vibration that a change of the amplitude leaves behind, as in FeedforwardDesign.
struct LeftBehind {
  double left = 0.0;
  double ratio_swing = 0.0;
};

/// @param design  of the scene, whose drive is fed forward, be it ramped or not
LeftBehind left_behind(const scene::Scene& scene, const NominalPlant& plant,
                       const ControlDesign& design, const std::optional<NotchDesign>& notch);

/// Ramp and notch are linear, so that what one leaves of the mode the other leaves a part of. The first
/// of these that leaves a swing of the friction ratio within the settling band: the ramp, a notch of
/// three taps, one of five. Where none does, the one that leaves least; of those a notch only if it
/// halves what the ramp leaves and spans at most 32 periods of the controller, since it takes time. A ramp that
/// leaves half of a jump's kick or more is none. A scene that names controller.shaping has that in place
/// of the choice.
/// @param design  of the scene, with its scales and its friction
FeedforwardDesign design_ramped(const scene::Scene& scene, const NominalPlant& plant,
                                const ControlDesign& design);

}  // namespace sonoglide::configure
