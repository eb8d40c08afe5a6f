#include "firmware/friction/lugre.hpp"

#include "host_sim/loop/compose_plant.hpp"
#include "host_sim/loop/friction_plants.hpp"

namespace sonoglide::loop {

std::unique_ptr<PlantPort> make_lugre_plant(const PlantDescription& description) {
  return compose_plant(description,
                       plant::Contact<friction::LuGre<double>>{
                           scene::lugre_numbers(description.scene.friction, description.scales),
                           description.numbers.friction_force, description.vibration_sign});
}

}  // namespace sonoglide::loop
