/// One reading function for each table of a scene.
#pragma once

#include "host_sim/scene/document.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::scene {

/// Each takes what its table depends on and throws SceneError for a value that is missing, out of
/// range, or of no use in this scene.
Plant read_plant(const Document& document);
Friction read_friction(const Document& document, const Plant& plant);
Sliding read_sliding(const Document& document);
std::optional<Drive> read_drive(const Document& document);
Solver read_solver(const Document& document);
Run read_run(const Document& document, const Scene& so_far);
std::optional<Controller> read_controller(const Document& document, const Scene& so_far);
Sensor read_sensor(const Document& document, const Friction& friction);
ModelError read_model_error(const Document& document, const Friction& friction);

}  // namespace sonoglide::scene
