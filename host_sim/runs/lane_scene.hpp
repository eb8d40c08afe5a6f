/// The plant of a scene as SIMD lanes take it.
#pragma once

#include <optional>

#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::runs {

/// The plant of a scene, in open loop under the scene's drive; of a closed loop the amplitude is 0.
/// Absent where the lanes cannot do it: they take a cosine drive, Dahl friction that does not
/// change, one sliding velocity, a given start, a natural mode between 1/8 and 1.1 times the carrier
/// (elsewhere the errors of the steps add up), and event_taylor or event_gauss with no order.
std::optional<batch::DahlPlant> lane_plant(const scene::Scene& scene);

}  // namespace sonoglide::runs
