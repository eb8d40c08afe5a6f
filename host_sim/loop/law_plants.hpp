/// The plants of one friction law, composed with every damping, drive and solver.
#pragma once

#include <memory>

#include "host_sim/loop/plant_description.hpp"
#include "host_sim/loop/plant_port.hpp"

namespace sonoglide::loop {

/// Defined in compose_plant.hpp. Each law has a translation unit of its own, which CMake makes of
/// law_plants.cpp.in: they take long to compile.
template <class Law>
std::unique_ptr<PlantPort> make_law_plant(const PlantDescription& description, const Law& law);

}  // namespace sonoglide::loop
