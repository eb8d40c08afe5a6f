#include "host_sim/scene_file/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sonoglide::scene_file {
namespace {

bool joins_names(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == ' ' || c == '\t' || static_cast<unsigned char>(c) >= 0x80;
}

/// Offset just past the string that opens at `begin`; a broken one ends with its line or the text.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string_view triple = quote == '"' ? "\"\"\"" : "'''";
  const bool multi_line = text.substr(begin, 3) == triple;
  std::size_t i = begin + (multi_line ? 3 : 1);
  while (i < text.size()) {
    if (text[i] == '\\' && quote == '"') {
      i += 2;
    } else if (multi_line && text.substr(i, 3) == triple) {
      return i + 3;
    } else if (!multi_line && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else {
      ++i;
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> find_excess_dot(std::string_view text) {
  int dots = 0;
  std::size_t i = 0;
  while (i < text.size()) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      dots = 0;
      continue;
    }
    if (c == '.' && ++dots > max_dots) {
      return i;
    }
    if (c != '.' && !joins_names(c)) {
      dots = 0;
    }
    ++i;
  }
  return std::nullopt;
}

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

/// Without what the library says of itself.
std::string finding_of(const toml::parse_error& error) {
  constexpr std::string_view preface = "Error while parsing ";
  std::string_view finding = error.description();
  if (finding.substr(0, preface.size()) == preface) {
    finding.remove_prefix(preface.size());
  }
  return std::string(finding.substr(0, finding.find(" (TOML_")));
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
    throw SceneError({file, place.line, place.column}, "toml",
                     finding_of(error) + "; allowed: TOML 1.0, in UTF-8");
  }
}

std::string name_of(const toml::key& key) {
  return key.empty() ? "\"\"" : std::string(key.str());
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? fmt::format("\"{}\"", text)
                                : fmt::format("\"{}\"…", text.substr(0, longest));
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
