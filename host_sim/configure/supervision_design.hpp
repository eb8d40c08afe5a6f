/// What a controller is to notice, and after how long.
#pragma once

#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// @pre regulator and vibration are designed
void design_supervision(const scene::Scene& scene, const NominalPlant& plant,
                        ControlDesign& design);

}  // namespace sonoglide::configure
