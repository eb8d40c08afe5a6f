/// What the composed plant of a scene is made from, and who makes it.
#pragma once

#include <memory>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

struct PlantDescription {
  const scene::Scene& scene;
  scene::PlantScales scales;
  configure::PlantNumbers numbers;

  explicit PlantDescription(const scene::Scene& described)
      : scene(described),
        scales(configure::plant_scales(described)),
        numbers(configure::plant_numbers(described, scales)) {}
};

/// Defined in compose_plant.hpp. Each law has a translation unit of its own, which CMake makes of
/// law_plants.cpp.in: they take long to compile.
template <class Law>
std::unique_ptr<PlantPort> make_law_plant(const PlantDescription& description, const Law& law);

/// The same of a scene with a load; made of law_loaded_plants.cpp.in.
template <class Law>
std::unique_ptr<PlantPort> make_loaded_plant(const PlantDescription& description, const Law& law);

}  // namespace sonoglide::loop
