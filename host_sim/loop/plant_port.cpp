#include "host_sim/loop/plant_port.hpp"

#include "host_sim/loop/law_plants.hpp"
#include "host_sim/loop/moving_friction_plant.hpp"

namespace sonoglide::loop {

std::unique_ptr<PlantPort> make_plant_port(const scene::Scene& scene) {
  if (scene.friction.has_profile()) {
    return std::make_unique<MovingFrictionPlant>(scene);
  }
  const PlantDescription description(scene);
  return std::visit([&](const auto& law) { return make_law_plant(description, law); },
                    scene::acting_law(scene.friction));
}

}  // namespace sonoglide::loop
