/// Echoes as scene files.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sonoglide::scene_file {

/// JSON's numbers, strings and arrays are TOML as they are.
inline std::string as_toml(const nlohmann::ordered_json& echo) {
  std::string text;
  for (const auto& [table, values] : echo.items()) {
    text += "[" + table + "]\n";
    for (const auto& [key, value] : values.items()) {
      text += key + " = " + value.dump() + "\n";
    }
  }
  return text;
}

}  // namespace sonoglide::scene_file
