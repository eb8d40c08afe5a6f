/// What one should know of a closed loop before it runs.
#pragma once

#include "host_sim/scene/scene.hpp"

namespace sonoglide::cli {

/// Prints the notes of the scene's controller design on standard error; none in open loop.
void print_design_notes(const scene::Scene& scene);

}  // namespace sonoglide::cli
