#include "host_sim/loop/plant_port.hpp"

#include "host_sim/loop/friction_plants.hpp"

namespace sonoglide::loop {

namespace {

std::unique_ptr<PlantPort> compose(const PlantDescription& description) {
  // Without a friction force there is no friction, whatever the law.
  if (description.scales.friction_N > 0.0) {
    switch (description.scene.friction.law) {
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

}  // namespace

std::unique_ptr<PlantPort> make_plant_port(const scene::Scene& scene) {
  std::unique_ptr<PlantPort> plant = compose(PlantDescription(scene));
  plant->begin_at({scene.plant.initial_displacement_m, scene.plant.initial_velocity_m_per_s,
                   scene.friction.initial_force_N});
  return plant;
}

}  // namespace sonoglide::loop
