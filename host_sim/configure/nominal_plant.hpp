/// What a controller takes the plant to be.
#pragma once

#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// The scene through [model_error].
struct NominalPlant : scene::Plant {
  double friction_N = 0.0;  ///< that the first slide of the scene meets without vibration
  double contact_stiffness_N_per_m = 0.0;
  double force_factor = 1.0;  ///< nominal over true

  /// The friction ratios that the targets mean, at most 1.
  std::vector<double> target_ratios(const scene::Controller& controller) const;
};

NominalPlant nominal_plant(const scene::Scene& scene);

}  // namespace sonoglide::configure
