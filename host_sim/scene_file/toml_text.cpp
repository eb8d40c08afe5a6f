#include "host_sim/scene_file/toml_text.hpp"

#include <fmt/format.h>

#include "host_sim/scene_file/dotted_depth.hpp"

namespace sonoglide::scene_file {
namespace {

Location place_of(std::string_view text, std::size_t offset, const std::string& file) {
  Location place{file, 1, 1};
  for (const char c : text.substr(0, offset)) {
    ++place.column;
    if (c == '\n') {
      ++place.line;
      place.column = 1;
    }
  }
  return place;
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file) {
  if (const auto excess = find_excess_dot(text)) {
    throw SceneError(place_of(text, *excess, file), "toml",
                     fmt::format("a name with more than {0} dots; allowed: at most {0}", max_dots));
  }
  try {
    return toml::parse(text, std::string_view(file));
  } catch (const toml::parse_error& error) {
    const toml::source_position& place = error.source().begin;
    throw SceneError({file, place.line, place.column}, "toml", std::string(error.description()));
  }
}

std::string_view kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a real number";
    case toml::node_type::boolean:
      return "a boolean";
    case toml::node_type::date:
      return "a date";
    case toml::node_type::time:
      return "a time of day";
    case toml::node_type::date_time:
      return "a date with time";
    case toml::node_type::none:
      break;
  }
  return "nothing";
}

}  // namespace sonoglide::scene_file
