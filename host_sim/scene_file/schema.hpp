/// The names of the tables and keys that a scene may hold.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sonoglide::scene_file {

/// A table has fewer keys than this.
inline constexpr std::size_t most_keys = 64;

struct TableSchema {
  std::string_view name;
  std::vector<std::string_view> keys;
};

/// Every table, in the order in which scenes are read and echoed.
const std::vector<TableSchema>& schema();

/// The table of this name; null if there is none.
const TableSchema* find_table(std::string_view name);

/// What to say of a top-level name that is no table: what is wrong, what is allowed.
std::string unknown_table(std::string_view name);

/// What to say of a key that this table does not have: what is wrong, what is allowed.
std::string unknown_key(const TableSchema& table, std::string_view key);

}  // namespace sonoglide::scene_file
