/// When and for how long the undriven friction force is learnt.
#pragma once

#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// The contact must slide through its presliding travel, and the sensor settle, before the friction
/// force can be learnt; in both directions where the sliding turns meanwhile.
/// @throws ConfigurationError  controller.calibration_s is too short for that
void design_calibration(const scene::Scene& scene, const NominalPlant& plant,
                        ControlDesign& design);

/// A pause long enough for the presliding travel, and for as many readings as their noise asks for.
/// @throws ConfigurationError  controller.relearn_every_s cannot be kept
void design_relearning(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design);

}  // namespace sonoglide::configure
