/// A scene written as a scene file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sonoglide::scene_file {

/// The text of an echo that to_json() has made: the scene that it is read as has the same echo.
std::string to_toml(const nlohmann::ordered_json& echo);

}  // namespace sonoglide::scene_file
