#include "host_sim/scene_file/override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/suggestion.hpp"
#include "host_sim/scene_file/toml_text.hpp"

namespace sonoglide::scene_file {
namespace {

std::string_view form(const Location& place) {
  return place.file == "--vary" ? "allowed: KEY=FROM:TO:COUNT, KEY=FROM:TO:COUNT:log or KEY=A,B,..."
                                : "allowed: TABLE.KEY=VALUE, or TABLE.KEY= to remove the key";
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_bare_word(std::string_view text) {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

void check_names(const OverriddenKey& target, const std::string& path) {
  const KeyTable* table = find_table(target.table);
  if (table == nullptr) {
    throw SceneError(target.place, path, unknown_table(target.table));
  }
  if (find_key(*table, target.key) == nullptr) {
    throw SceneError(target.place, path, unknown_key(*table, target.key));
  }
}

/// The names that a dotted key of TOML joins, without their quotes, joined by dots.
/// @throws SceneError  no TOML key
std::string unquoted(const std::string& path, const Location& place) {
  if (path.find_first_of("\"'") == std::string::npos) {
    return path;
  }
  toml::table holder;
  try {
    holder = parse_toml(path + " = 0", place.file);
  } catch (const SceneError&) {
    throw SceneError(place, path, fmt::format("is no name of a key; {}", form(place)));
  }
  std::string names;
  const toml::table* table = &holder;
  while (table != nullptr && table->size() == 1) {
    const auto only = table->begin();
    names += fmt::format("{}{}", names.empty() ? "" : ".", name_of(only->first));
    table = only->second.as_table();
  }
  if (table != nullptr) {
    throw SceneError(place, path, fmt::format("more than one key; {}", form(place)));
  }
  return names;
}

/// Fills in table and key.
void split_path(OverriddenKey& target, const std::string& path) {
  const std::size_t dot = path.find('.');
  target.table = path.substr(0, dot);
  const KeyTable* table = find_table(target.table);
  const int most_dots = table != nullptr && table->of_others ? 2 : 1;
  if (path.find('[') != std::string::npos ||
      std::count(path.begin(), path.end(), '.') > most_dots) {
    throw SceneError(target.place, path,
                     fmt::format("a part of a value cannot be set; {}", form(target.place)));
  }
  if (dot == std::string::npos) {
    throw SceneError(target.place, path,
                     find_table(path) != nullptr
                         ? fmt::format("a whole table cannot be set; {}", form(target.place))
                         : unknown_table(path));
  }
  target.key = path.substr(dot + 1);
}

}  // namespace

toml::table parse_value(const std::string& value, const std::string& key, const Location& place) {
  toml::table holder;
  try {
    holder = parse_toml("value = " + value, place.file);
  } catch (const SceneError&) {
    if (!is_bare_word(value)) {
      throw SceneError(
          place, key,
          fmt::format("{} is no TOML value; allowed: a number with a decimal point, "
                      "true, false, a list in [ ], a table in {{ }} that has each key once, "
                      "a text in \" \" or a bare word",
                      in_quotes(value)));
    }
    holder.insert("value", value);
  }
  if (holder.size() != 1) {
    throw SceneError(place, key, "more than one value; allowed: one TOML value or a bare word");
  }
  return holder;
}

OverriddenKey parse_overridden_key(const std::string& text, Location place) {
  OverriddenKey target;
  target.place = std::move(place);
  if (text.empty()) {
    throw SceneError(target.place, target.place.file,
                     fmt::format("no key; {}", form(target.place)));
  }
  const std::string path = unquoted(text, target.place);
  split_path(target, path);
  check_names(target, path);
  return target;
}

Override parse_override(const std::string& text, std::size_t ordinal) {
  const std::size_t equals = text.find('=');
  const std::string path = text.substr(0, equals);
  const Location place{"--set", ordinal, 1};
  if (equals == std::string::npos && !path.empty()) {
    throw SceneError(place, path, fmt::format("no value; {}", form(place)));
  }
  OverriddenKey target = parse_overridden_key(path, place);
  const std::string value = text.substr(equals + 1);
  if (value.empty()) {
    return {std::move(target), std::nullopt};
  }
  toml::table holder = parse_value(value, path, target.place);
  return {std::move(target), std::move(holder)};
}

}  // namespace sonoglide::scene_file
