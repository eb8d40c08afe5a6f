/// One reading function for each table of a scene.
#pragma once

#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::scene_file {

/// Each takes what its table depends on and throws SceneError for a value that is missing, out of
/// range, or of no use in this scene.
scene::Plant read_plant(const Variant& variant);
scene::Friction read_friction(const Variant& variant, const scene::Plant& plant);
scene::Sliding read_sliding(const Variant& variant, const scene::Friction& friction);
std::optional<scene::Transducer> read_transducer(const Variant& variant);
std::optional<scene::Drive> read_drive(const Variant& variant,
                                       const std::optional<scene::Transducer>& transducer);
scene::Solver read_solver(const Variant& variant);
scene::Run read_run(const Variant& variant, const scene::Scene& so_far);
std::optional<scene::Controller> read_controller(const Variant& variant,
                                                 const scene::Scene& so_far);
scene::Sensor read_sensor(const Variant& variant, const scene::Scene& so_far);
scene::ModelError read_model_error(const Variant& variant, const scene::Scene& so_far);

}  // namespace sonoglide::scene_file
