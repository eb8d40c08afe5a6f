/// The plants of each friction law. One translation unit for each: a law is composed with every
/// damping, drive and solver.
#pragma once

#include <memory>

#include "host_sim/loop/plant_description.hpp"
#include "host_sim/loop/plant_port.hpp"

namespace sonoglide::loop {

std::unique_ptr<PlantPort> make_frictionless_plant(const PlantDescription& description);
std::unique_ptr<PlantPort> make_coulomb_plant(const PlantDescription& description);
std::unique_ptr<PlantPort> make_stribeck_plant(const PlantDescription& description);
std::unique_ptr<PlantPort> make_dahl_plant(const PlantDescription& description);
std::unique_ptr<PlantPort> make_lugre_plant(const PlantDescription& description);

}  // namespace sonoglide::loop
