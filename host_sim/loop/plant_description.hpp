/// What every composition of a scene's plant is filled in from.
#pragma once

#include "host_sim/scene/plant_scales.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

struct PlantDescription {
  const scene::Scene& scene;
  scene::PlantScales scales;
  scene::PlantNumbers numbers;

  explicit PlantDescription(const scene::Scene& described)
      : scene(described),
        scales(scene::plant_scales(described)),
        numbers(scene::plant_numbers(described, scales)) {}
};

}  // namespace sonoglide::loop
