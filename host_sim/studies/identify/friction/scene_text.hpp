/// A fitted law as a scene that runs.
#pragma once

#include <string>

#include "host_sim/studies/identify/friction/comparison.hpp"

namespace sonoglide::identify::friction {

/// An open-loop scene of the best law at the middle one of the readings with vibration, whose
/// friction ratio is that of the fit. What no reading tells is assumed, and said so in comments: a
/// mass that friction hardly moves, a spring far below resonance, the friction coefficient, and the
/// friction limit or the carrier where the file does not have them.
std::string scene_text(const Comparison& comparison);

}  // namespace sonoglide::identify::friction
