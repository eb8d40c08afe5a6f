#include "host_sim/scene/override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "host_sim/scene/schema.hpp"
#include "host_sim/scene/toml_text.hpp"

namespace sonoglide::scene {
namespace {

constexpr std::string_view form = "allowed: TABLE.KEY=VALUE";

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_bare_word(std::string_view text) {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

toml::table parse_value(const std::string& value, const std::string& key, const Location& place) {
  toml::table holder;
  try {
    holder = parse_toml("value = " + value, place.file);
  } catch (const SceneError& error) {
    if (!is_bare_word(value)) {
      throw SceneError(place, key,
                       fmt::format("{}; allowed: a TOML value or a bare word", error.message()));
    }
    holder.insert("value", value);
  }
  if (holder.size() != 1) {
    throw SceneError(place, key, "more than one value; allowed: one TOML value or a bare word");
  }
  return holder;
}

void check_names(const Override& override, const std::string& path) {
  const TableSchema* table = find_table(override.table);
  if (table == nullptr) {
    throw SceneError(override.place, path, unknown_table(override.table));
  }
  if (std::find(table->keys.begin(), table->keys.end(), override.key) == table->keys.end()) {
    throw SceneError(override.place, path, unknown_key(*table, override.key));
  }
}

/// Fills in table and key.
void split_path(Override& override, const std::string& path) {
  if (path.find('[') != std::string::npos || std::count(path.begin(), path.end(), '.') > 1) {
    throw SceneError(override.place, path,
                     fmt::format("a part of a value cannot be set; {}", form));
  }
  const std::size_t dot = path.find('.');
  override.table = path.substr(0, dot);
  if (dot == std::string::npos) {
    throw SceneError(override.place, path,
                     find_table(path) != nullptr
                         ? fmt::format("a whole table cannot be set; {}", form)
                         : unknown_table(path));
  }
  override.key = path.substr(dot + 1);
}

}  // namespace

Override parse_override(const std::string& text, std::size_t ordinal) {
  Override override;
  override.place = {"--set", ordinal, 1};
  const std::size_t equals = text.find('=');
  const std::string path = text.substr(0, equals);
  if (path.empty()) {
    throw SceneError(override.place, "--set", fmt::format("no key; {}", form));
  }
  if (equals == std::string::npos) {
    throw SceneError(override.place, path, fmt::format("no value; {}", form));
  }
  split_path(override, path);
  check_names(override, path);
  const std::string value = text.substr(equals + 1);
  if (value.empty()) {
    throw SceneError(override.place, path, fmt::format("no value; {}", form));
  }
  override.holder = parse_value(value, path, override.place);
  return override;
}

}  // namespace sonoglide::scene
