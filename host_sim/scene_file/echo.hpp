/// A scene echoed, as JSON and as a scene file, and in what it differs from its file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/source.hpp"

namespace sonoglide::scene_file {

/// Holds what the scene uses and nothing else, so that the echo, written as TOML, is a scene again,
/// and the same one. Times are in seconds, a constant sliding velocity is under its own key. With true values the
/// other tables have what the controller believes.
nlohmann::ordered_json to_json(const scene::Scene& scene);

/// The text of an echo that to_json() has made: the scene that it is read as has the same echo.
std::string to_toml(const nlohmann::ordered_json& echo);

/// The keys to which `--set` gives another value than the file does, in the order of the options:
/// `{"drive.frequency_Hz": {"file": 60000.0, "value": 61000.0}}`, null where there is none.
/// @throws SceneError  as Document does
nlohmann::ordered_json changes(const Source& source, const std::vector<std::string>& overrides);

}  // namespace sonoglide::scene_file
