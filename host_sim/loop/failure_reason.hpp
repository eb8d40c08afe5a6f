/// Why a solver could not go on, in words.
#pragma once

#include <string>

#include "firmware/plant/outcome.hpp"
#include "host_sim/loop/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Time, state and reason; where the steps ran out, what they were spent on.
std::string failure_reason(const scene::Scene& scene, plant::Error error, double time_s,
                           const PlantState& state, const plant::Cost& cost);

}  // namespace sonoglide::loop
