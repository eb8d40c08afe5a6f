/// What every composition of a scene's plant is filled in from.
#pragma once

#include "host_sim/configure/plant_scales.hpp"
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

}  // namespace sonoglide::loop
