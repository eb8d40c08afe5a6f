/// One `--set TABLE.KEY=VALUE` option.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <string>

#include "host_sim/scene/scene_error.hpp"

namespace sonoglide::scene {

struct Override {
  std::string table;
  std::string key;
  toml::table holder;  ///< owns the value, under the name `value`
  Location place;      ///< file "--set", line the ordinal of the option, column 1
};

/// VALUE is TOML; a bare word that is not (`q31`) is a string.
///
/// @param ordinal  1 for the first option
/// @throws SceneError  not of that form, or a table or key that no scene has
Override parse_override(const std::string& text, std::size_t ordinal);

}  // namespace sonoglide::scene
