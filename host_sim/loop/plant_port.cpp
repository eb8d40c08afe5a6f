#include "host_sim/loop/plant_port.hpp"

#include "host_sim/loop/friction_plants.hpp"

namespace sonoglide::loop {

std::unique_ptr<PlantPort> make_plant_port(const scene::Scene& scene) {
  const PlantDescription description(scene);
  // Without a friction force there is no friction, whatever the law.
  if (description.scales.friction_N > 0.0) {
    switch (scene.friction.law) {
      case scene::FrictionLaw::dahl:
        return make_dahl_plant(description);
      case scene::FrictionLaw::coulomb:
        return make_coulomb_plant(description);
      case scene::FrictionLaw::none:
        break;
    }
  }
  return make_frictionless_plant(description);
}

}  // namespace sonoglide::loop
