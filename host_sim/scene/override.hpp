/// One `--set TABLE.KEY=VALUE` option.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <string>

#include "host_sim/scene/scene_error.hpp"

namespace sonoglide::scene {

/// The key that an option sets.
struct OverriddenKey {
  std::string table;
  std::string key;
  Location place;  ///< file "--set", line the ordinal of the option, column 1
};

struct Override {
  OverriddenKey target;
  toml::table holder;  ///< owns the value, under the name `value`
};

/// TABLE.KEY alone.
///
/// @param ordinal  1 for the first option
/// @throws SceneError  not of that form, or a table or key that no scene has
OverriddenKey parse_overridden_key(const std::string& path, std::size_t ordinal);

/// VALUE is TOML; a bare word that is not (`q31`) is a string.
///
/// @param ordinal  1 for the first option
/// @throws SceneError  not of that form, or a table or key that no scene has
Override parse_override(const std::string& text, std::size_t ordinal);

}  // namespace sonoglide::scene
