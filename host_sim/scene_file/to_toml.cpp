#include "host_sim/scene_file/to_toml.hpp"

#include <fmt/format.h>

namespace sonoglide::scene_file {
namespace {

using nlohmann::ordered_json;

/// A dot would part the key.
std::string key_text(const std::string& key) {
  return key.find('.') == std::string::npos ? key : fmt::format("\"{}\"", key);
}

/// JSON's numbers, strings, truths and arrays are TOML as they are.
std::string value_text(const ordered_json& value) {
  if (!value.is_object()) {
    return value.dump();
  }
  std::string text;
  for (const auto& [key, member] : value.items()) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key_text(key), value_text(member));
  }
  return fmt::format("{{ {} }}", text);
}

}  // namespace

std::string to_toml(const ordered_json& echo) {
  std::string text;
  for (const auto& [table, values] : echo.items()) {
    text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", table);
    for (const auto& [key, value] : values.items()) {
      text += fmt::format("{} = {}\n", key_text(key), value_text(value));
    }
  }
  return text;
}

}  // namespace sonoglide::scene_file
