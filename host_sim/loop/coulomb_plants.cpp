#include "firmware/friction/coulomb.hpp"
#include "host_sim/loop/compose_plant.hpp"
#include "host_sim/loop/friction_plants.hpp"

namespace sonoglide::loop {

std::unique_ptr<PlantPort> make_coulomb_plant(const PlantDescription& description) {
  return compose_plant(description,
                       plant::Contact<friction::Coulomb<double>>{
                           {}, description.numbers.friction_force, description.vibration_sign});
}

}  // namespace sonoglide::loop
