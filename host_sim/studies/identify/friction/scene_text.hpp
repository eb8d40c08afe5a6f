/// A fitted law as a scene that runs.
#pragma once

#include <string>

#include "host_sim/studies/identify/friction/comparison.hpp"

namespace sonoglide::identify::friction {

/// The reading that the scene of the best law is of: the middle one of those with vibration.
const Reading& scene_reading(const Comparison& comparison);

/// An open-loop scene of the best law at scene_reading(), whose friction ratio is that of the fit.
/// What no reading tells is assumed, and said so in comments: a mass that friction hardly moves, a
/// spring far below resonance, the friction coefficient, and the friction limit or the carrier where
/// the file does not have them.
std::string scene_text(const Comparison& comparison);

/// Why scene_text() is no scene, in one line; empty where it is one.
std::string scene_refusal(const Comparison& comparison);

}  // namespace sonoglide::identify::friction
