/// One `--set TABLE.KEY=VALUE` or `--set TABLE.KEY=` option.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <optional>
#include <string>

#include "host_sim/scene_file/scene_error.hpp"

namespace sonoglide::scene_file {

/// The key that an option sets.
struct OverriddenKey {
  std::string table;
  std::string key;
  Location place;  ///< file "--set" or "--vary", line the ordinal of the option, column 1
};

struct Override {
  OverriddenKey target;
  std::optional<toml::table> holder;  ///< owns the value, under the name `value`; absent: remove it
};

/// VALUE alone, under the name `value`.
/// @param key, place  what an error shows
/// @throws SceneError  neither TOML nor a bare word, or more than one value
toml::table parse_value(const std::string& value, const std::string& key, const Location& place);

/// TABLE.KEY alone, each in quotes or not, as in TOML. The quotes about a key of [tolerance] or
/// [true_values], which has a dot, may be left out.
///
/// @throws SceneError  not of that form, or a table or key that no scene has
OverriddenKey parse_overridden_key(const std::string& text, Location place);

/// VALUE is TOML; a bare word that is not (`q31`) is a string. Without VALUE the key is to be
/// removed, so that another can take its place.
///
/// @param ordinal  1 for the first option
/// @throws SceneError  not of that form, or a table or key that no scene has
Override parse_override(const std::string& text, std::size_t ordinal);

}  // namespace sonoglide::scene_file
