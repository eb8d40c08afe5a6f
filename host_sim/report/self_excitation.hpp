/// Target steps of a closed loop in which falling friction feeds an oscillation.
#pragma once

#include <string>
#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// Whether there can be such steps: friction that falls with the velocity, a cosine drive and a plant
/// without profiles, for which steady sliding can be computed.
bool may_excite_itself(const scene::Scene& scene);

/// Whether the steady motion under a constant drive repels.
/// @param scene  that may excite itself
bool excites_itself(const scene::Scene& scene, double time_s, double drive_force_N);

/// A sentence for each target whose drive lies in a window in which it repels; before the run.
/// @param scene  any
std::vector<std::string> self_excitation_notes(const scene::Scene& scene);

/// How narrow a window of the drive may be and still be missed, in a sentence.
/// @param most_N  the strongest drive of the scan
std::string missed_windows_text(double most_N);

}  // namespace sonoglide::report
