/// How much of a friction ratio hangs on each parameter.
#pragma once

#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::design {

/// One positive number of a scene that its steady ratio depends on.
struct SceneParameter {
  const char* key;  ///< as `--set` takes it
  const char* symbol;
  double& (*in)(scene::Scene& steady_scene);
};

/// Those that the scene has: damping where it is not 0, contact stiffness of an elastic law.
std::vector<SceneParameter> parameters_of(const scene::Scene& steady_scene);

/// Every other parameter and the drive's force stay as they are: feedback that follows the ratio
/// takes the change out again, feedforward does not. NaN where a plant with the changed parameter
/// settles on no orbit.
struct Sensitivity {
  SceneParameter parameter;
  double logarithmic;     ///< d ln rho / d ln p
  double change_by_more;  ///< of the ratio, by 1 % more of the parameter
  double change_by_less;  ///< by 1 % less

  double largest_change() const;  ///< magnitude; NaN where one of the two is
};

/// Of every parameter, by differences of the ratio on the steady orbit.
/// Error: of the derivative 1e-5, of the changes 1e-9.
/// @throws loop::ComputationError  no steady orbit
std::vector<Sensitivity> sensitivities(const scene::Scene& steady_scene);

/// The changes that a Sensitivity holds: relative.
inline constexpr double parameter_change = 0.01;

/// Ratio with the parameter taken times a factor. @throws loop::ComputationError
double ratio_with(scene::Scene steady_scene, const SceneParameter& parameter, double factor);

/// Of the spring, on which resonance hangs.
SceneParameter stiffness();

}  // namespace sonoglide::design
