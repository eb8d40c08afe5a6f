#include "firmware/friction/none.hpp"
#include "host_sim/loop/compose_plant.hpp"
#include "host_sim/loop/friction_plants.hpp"

namespace sonoglide::loop {

std::unique_ptr<PlantPort> make_frictionless_plant(const PlantDescription& description) {
  return compose_plant(description, plant::Contact<friction::None<double>>{});
}

}  // namespace sonoglide::loop
