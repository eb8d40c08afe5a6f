/// "Did you mean …?" for a name that is not known.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace sonoglide::scene_file {

/// Least number of insertions, deletions, substitutions and swaps of neighbours that turn one name
/// into the other, no part edited twice (optimal string alignment); letter case is ignored.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to `name`, the first one of several; none if even that one is far. Near
/// means at most two edits, or a quarter of the longer name, or a name whose unit is left out.
std::optional<std::string_view> nearest_name(std::string_view name,
                                             const std::vector<std::string_view>& known);

}  // namespace sonoglide::scene_file
