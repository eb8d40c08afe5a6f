/// What every composition of a scene's plant is filled in from.
#pragma once

#include "host_sim/scene/plant_scales.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

struct PlantDescription {
  const scene::Scene& scene;
  scene::PlantScales scales;
  scene::PlantNumbers numbers;
  double vibration_sign;  ///< +1 dissipative, −1 as printed

  explicit PlantDescription(const scene::Scene& described)
      : scene(described),
        scales(scene::plant_scales(described)),
        numbers(scene::plant_numbers(described, scales)),
        vibration_sign(scene::vibration_sign(described.friction.sign_convention)) {}
};

}  // namespace sonoglide::loop
