/// TOML text to nodes, with every failure a SceneError.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "host_sim/scene_file/scene_error.hpp"

namespace sonoglide::scene_file {

/// Scenes need one dot. The parser makes as many tables as a key has dots, without a bound of its
/// own, and frees them recursively: a long key would exhaust the stack.
inline constexpr int max_dots = 16;

/// Offset of the first dot beyond max_dots in one dotted name; dots in strings and comments do not
/// count. None in a text that the parser may see.
std::optional<std::size_t> find_excess_dot(std::string_view text);

/// @throws SceneError, key `toml`: not TOML 1.0, or keys dotted so deeply that their tables could
///         exhaust the stack.
toml::table parse_toml(std::string_view text, const std::string& file);

/// The name of a key or table as messages give it: an empty one, which TOML allows, is `""`.
std::string name_of(const toml::key& key);

/// A text that somebody gave, in quotes and short enough for a message.
std::string in_quotes(std::string_view text);

/// The kind of a value with its article: "a string", "an integer", …
std::string_view kind_of(const toml::node& node);

}  // namespace sonoglide::scene_file
