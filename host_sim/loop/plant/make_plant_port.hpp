/// The plant of a scene.
#pragma once

#include <memory>

#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// The plant of a scene, composed of exactly what the scene names, in its initial state.
std::unique_ptr<PlantPort> make_plant_port(const scene::Scene& scene);

}  // namespace sonoglide::loop
