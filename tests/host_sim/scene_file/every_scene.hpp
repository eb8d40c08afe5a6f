/// Scene texts that together have every key.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "scene_texts.hpp"

namespace sonoglide::scene_file {

/// With a tolerance of each number that the scene has, as wide as its key allows, or with a true
/// value of each, which is the scene's where it is real.
/// @param table  tolerance or true_values
inline std::string with_every_number(const std::string& text, const char* table) {
  const nlohmann::ordered_json echo = to_json(read_text(text, "s"));
  std::string added = fmt::format("{}\n[{}]\n", text, table);
  for (const Key& key : find_table(table)->keys) {
    const std::string path(key.name);
    const std::size_t dot = path.find('.');
    const auto of_table = echo.find(path.substr(0, dot));
    if (of_table == echo.end() || !of_table->contains(path.substr(dot + 1))) {
      continue;
    }
    const auto* spread = std::get_if<Spread>(&key.allowed);
    added += fmt::format("\"{}\" = ", path);
    const auto* integer = std::get_if<Integer>(&key.allowed);
    added += integer != nullptr  ? std::to_string(integer->low)
             : spread == nullptr ? of_table->at(path.substr(dot + 1)).dump()
             : spread->whole     ? fmt::format("{{ range = [{:.0f}, {:.0f}] }}", spread->range.low,
                                               spread->range.low + 1.0)
                             : fmt::format("{{ range = [{:.17g}, {:.17g}] }}", spread->range.low,
                                           spread->range.high);
    added += '\n';
  }
  return added;
}

inline std::vector<std::string> every_scene() {
  std::vector<std::string> texts = {
      fullest_open_loop,    curve_open_loop,    bristles_open_loop,   springs_open_loop,
      normal_open_loop,     profiles_open_loop, transducer_open_loop, transducer_closed_loop,
      resonant_closed_loop, damped_closed_loop, fullest_closed_loop,  load_open_loop,
      textured_closed_loop};
  const std::vector<std::string> plain = texts;
  for (const std::string& text : plain) {
    texts.push_back(with_every_number(text, "tolerance"));
    texts.push_back(with_every_number(text, "true_values"));
  }
  return texts;
}

}  // namespace sonoglide::scene_file
