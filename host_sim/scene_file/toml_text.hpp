/// TOML text to nodes, with every failure a SceneError.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "host_sim/scene_file/scene_error.hpp"

namespace sonoglide::scene_file {

/// @throws SceneError, key `toml`: not TOML 1.0, or keys dotted so deeply that their tables could
///         exhaust the stack.
toml::table parse_toml(std::string_view text, const std::string& file);

/// The kind of a value with its article: "a string", "an integer", …
std::string_view kind_of(const toml::node& node);

}  // namespace sonoglide::scene_file
