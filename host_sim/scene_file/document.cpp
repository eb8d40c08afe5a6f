#include "host_sim/scene_file/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/suggestion.hpp"
#include "host_sim/scene_file/toml_text.hpp"

namespace sonoglide::scene_file {
namespace {

Location located(const std::string& file, const toml::source_region& source) {
  return {file, source.begin.line, source.begin.column};
}

using Item = std::pair<const toml::key*, const toml::node*>;

/// The parser sorts by name; errors come in file order.
std::vector<Item> in_file_order(const toml::table& table) {
  std::vector<Item> items;
  for (const auto& [key, value] : table) {
    items.emplace_back(&key, &value);
  }
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    return a.first->source().begin < b.first->source().begin;
  });
  return items;
}

}  // namespace

Location GivenValue::place_of(const toml::node& element) const {
  return overridden ? value_place : located(value_place.file, element.source());
}

Document::Document(const Source& source, const std::vector<std::string>& overrides,
                   const std::vector<std::string>& varied)
    : file_(source.file), name_(source.name()) {
  if (source.text.size() > max_bytes) {
    throw SceneError(start(), "scene",
                     fmt::format("larger than {0} bytes; allowed: at most {0} bytes", max_bytes));
  }
  root_ = parse_toml(source.text, file_);
  collect();
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    apply_override(overrides[i], i + 1);
  }
  for (std::size_t i = 0; i < varied.size(); ++i) {
    vary(varied[i], i);
  }
  place_true_values();
}

const SceneTable* Document::find(std::string_view name) const {
  const auto found = tables_.find(name);
  return found == tables_.end() ? nullptr : &found->second;
}

const SceneTable* Document::find_true(std::string_view name) const {
  const auto found = true_tables_.find(name);
  return found == true_tables_.end() ? find(name) : &found->second;
}

const GivenValue* Document::given(std::string_view dotted_key) const {
  const std::size_t dot = dotted_key.find('.');
  const SceneTable* table = find(dotted_key.substr(0, dot));
  if (table == nullptr || dot == std::string_view::npos) {
    return nullptr;
  }
  const auto entry = table->entries.find(dotted_key.substr(dot + 1));
  return entry == table->entries.end() ? nullptr : &entry->second;
}

Location Document::place_of(std::string_view dotted_key) const {
  if (const GivenValue* value = given(dotted_key)) {
    return value->value_place;
  }
  const SceneTable* table = find(dotted_key.substr(0, dotted_key.find('.')));
  return table == nullptr ? start() : table->place;
}

void Document::collect() {
  for (const auto& [key, value] : in_file_order(root_)) {
    const std::string name = name_of(*key);
    const Location place = located(file_, key->source());
    if (find_table(name) == nullptr) {
      throw SceneError(place, name, unknown_table(name));
    }
    const toml::table* table = value->as_table();
    if (table == nullptr) {
      throw SceneError(place, name,
                       fmt::format("is {}; allowed: one table, [{}]", kind_of(*value), name));
    }
    collect_table(name, place, *table);
  }
}

void Document::collect_table(const std::string& name, const Location& place,
                             const toml::table& table) {
  const KeyTable& described = *find_table(name);
  SceneTable collected{name, place, {}};
  for (const auto& [key, value] : in_file_order(table)) {
    const Location key_place = located(file_, key->source());
    const std::string key_name = name_of(*key);
    if (find_key(described, key_name) == nullptr) {
      throw SceneError(key_place, fmt::format("{}.{}", name, key_name),
                       unknown_key(described, key_name));
    }
    collected.entries[key_name] = {value, key_place, located(file_, value->source())};
  }
  tables_[name] = std::move(collected);
}

void Document::apply_override(const std::string& text, std::size_t ordinal) {
  Override override = parse_override(text, ordinal);
  if (!override.holder) {
    remove(override.target);
    return;
  }
  override_values_.push_back(std::move(*override.holder));
  overridden_entry(override.target).value = override_values_.back().get("value");
}

void Document::remove(const OverriddenKey& target) {
  const auto table = tables_.find(target.table);
  if (table != tables_.end()) {
    table->second.lost_keys |= table->second.entries.erase(target.key) > 0;
  }
}

void Document::vary(const std::string& path, std::size_t index) {
  overridden_entry(parse_overridden_key(path, {"--vary", index + 1, 1})).varied = index;
}

void Document::place_true_values() {
  const SceneTable* true_values = find("true_values");
  if (true_values == nullptr) {
    return;
  }
  for (const auto& [path, given] : true_values->entries) {
    const std::size_t dot = path.find('.');
    const std::string name = path.substr(0, dot);
    const SceneTable* stated = find_true(name);
    SceneTable table = stated != nullptr ? *stated : SceneTable{name, given.key_place, {}};
    table.entries[path.substr(dot + 1)] = given;
    true_tables_[name] = std::move(table);
  }
}

/// The entry, without a value yet.
GivenValue& Document::overridden_entry(const OverriddenKey& target) {
  SceneTable& table =
      tables_.try_emplace(target.table, SceneTable{target.table, target.place, {}}).first->second;
  return table.entries[target.key] = {nullptr, target.place, target.place, true};
}

}  // namespace sonoglide::scene_file
