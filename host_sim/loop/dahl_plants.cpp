#include "firmware/friction/dahl.hpp"
#include "host_sim/loop/compose_plant.hpp"
#include "host_sim/loop/friction_plants.hpp"

namespace sonoglide::loop {

std::unique_ptr<PlantPort> make_dahl_plant(const PlantDescription& description) {
  return compose_plant(
      description, plant::Contact<friction::Dahl<double>>{{description.numbers.contact_stiffness},
                                                          description.numbers.friction_force,
                                                          description.vibration_sign});
}

}  // namespace sonoglide::loop
