/// What is run: a plant, and a controller for what that is taken to be.
#pragma once

#include <optional>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Two scenes side by side; they are equal where the scene file gives no true values.
struct Experiment {
  scene::Scene plant;    ///< what moves
  scene::Scene nominal;  ///< what the file states, and the controller is designed for
  std::optional<ControlDesign> design;  ///< in closed loop
};

/// Designs the controller of a closed loop, once, and fills in the values that are absent and follow
/// from the design: controller.calibration_s and controller.shaping_range.
/// @param plant  the scene with its true values; absent: as it is stated
/// @throws ConfigurationError  as design_control()
Experiment make_experiment(scene::Scene stated, std::optional<scene::Scene> plant = std::nullopt);

}  // namespace sonoglide::configure
