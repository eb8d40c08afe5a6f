/// The scene echoed: the TOML file's tables and keys, every default filled in.
#pragma once

#include <nlohmann/json.hpp>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::scene_file {

/// Holds what the scene uses and nothing else, so that the echo, written as TOML, is a scene again,
/// and the same one. Times are in seconds, a constant sliding velocity is under its own key. With true values the
/// other tables have what the controller believes.
nlohmann::ordered_json to_json(const scene::Scene& scene);

}  // namespace sonoglide::scene_file
