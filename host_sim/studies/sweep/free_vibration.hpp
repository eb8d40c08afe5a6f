/// What the start of a run leaves in the means of a sweep.
#pragma once

#include <string>
#include <vector>

#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/sweep/plan.hpp"

namespace sonoglide::sweep {

/// Velocity amplitude of the free vibration when the window begins, over that of the driven one,
/// both without a contact, whose friction makes it less: with x0, v0 where the run begins and X the
/// phasor of the driven vibration,
///   |(w0 (x0 - Re X), v0 + w Im X)| exp(-c t/2m) / (w |X|).
/// 0 in closed loop, for a steady start, and without a drive or a spring; of an overdamped plant 0.
double free_vibration_part(const scene::Scene& scene);

/// A sentence where that is more than a hundredth at some point; of a large sweep, of points evenly
/// spread over it.
std::vector<std::string> start_notes(const Plan& plan);

}  // namespace sonoglide::sweep
