#include "host_sim/scene_file/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/suggestion.hpp"

namespace sonoglide::scene_file {
namespace {

/// The table that owns this key; null if none does.
const TableSchema* find_owner(std::string_view key) {
  for (const TableSchema& table : schema()) {
    if (std::find(table.keys.begin(), table.keys.end(), key) != table.keys.end()) {
      return &table;
    }
  }
  return nullptr;
}

std::vector<std::string_view> table_names() {
  std::vector<std::string_view> names;
  for (const TableSchema& table : schema()) {
    names.push_back(table.name);
  }
  return names;
}

std::vector<TableSchema> described_tables() {
  std::vector<TableSchema> tables;
  for (const KeyTable& table : key_tables()) {
    tables.push_back({table.name, {}});
    for (const Key& key : table.keys) {
      tables.back().keys.push_back(key.name);
    }
  }
  return tables;
}

}  // namespace

const std::vector<TableSchema>& schema() {
  static const std::vector<TableSchema> tables = described_tables();
  return tables;
}

const TableSchema* find_table(std::string_view name) {
  for (const TableSchema& table : schema()) {
    if (table.name == name) {
      return &table;
    }
  }
  return nullptr;
}

std::string unknown_table(std::string_view name) {
  if (const TableSchema* owner = find_owner(name)) {
    return fmt::format("unknown table; did you mean {}.{}?", owner->name, name);
  }
  const std::vector<std::string_view> names = table_names();
  if (const auto nearest = nearest_name(name, names)) {
    return fmt::format("unknown table; did you mean {}?", *nearest);
  }
  return fmt::format("unknown table; allowed: {}", fmt::join(names, ", "));
}

std::string unknown_key(const TableSchema& table, std::string_view key) {
  if (const auto nearest = nearest_name(key, table.keys)) {
    return fmt::format("unknown key; did you mean {}?", *nearest);
  }
  if (const TableSchema* owner = find_owner(key)) {
    return fmt::format("unknown key; did you mean {}.{}?", owner->name, key);
  }
  return fmt::format("unknown key; allowed: {}", fmt::join(table.keys, ", "));
}

}  // namespace sonoglide::scene_file
