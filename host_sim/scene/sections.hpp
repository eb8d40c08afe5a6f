/// One reading function for each table of a scene.
#pragma once

#include "host_sim/scene/scene.hpp"
#include "host_sim/scene/variant.hpp"

namespace sonoglide::scene {

/// Each takes what its table depends on and throws SceneError for a value that is missing, out of
/// range, or of no use in this scene.
Plant read_plant(const Variant& variant);
Friction read_friction(const Variant& variant, const Plant& plant);
Sliding read_sliding(const Variant& variant, const Friction& friction);
std::optional<Drive> read_drive(const Variant& variant);
Solver read_solver(const Variant& variant);
Run read_run(const Variant& variant, const Scene& so_far);
std::optional<Controller> read_controller(const Variant& variant, const Scene& so_far);
Sensor read_sensor(const Variant& variant, const Friction& friction);
ModelError read_model_error(const Variant& variant, const Friction& friction);

}  // namespace sonoglide::scene
