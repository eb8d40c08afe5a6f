/// "Did you mean …?" for a name that is not known.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene_file/keys.hpp"

namespace sonoglide::scene_file {

/// Least number of insertions, deletions, substitutions and swaps of neighbours that turn one name
/// into the other, no part edited twice (optimal string alignment); letter case is ignored.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to `name`, the first one of several; none if even that one is far. Near
/// means at most two edits, or a quarter of the longer name, or a name whose unit is left out.
std::optional<std::string_view> nearest_name(std::string_view name,
                                             const std::vector<std::string_view>& known);

/// What to say of a top-level name that is no table: what is wrong, what is allowed.
std::string unknown_table(std::string_view name);

/// What to say of a key that this table does not have: what is wrong, what is allowed.
std::string unknown_key(const KeyTable& table, std::string_view key);

}  // namespace sonoglide::scene_file
