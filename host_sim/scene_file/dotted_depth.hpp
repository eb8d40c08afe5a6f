/// Bound on how deeply the dotted keys of a TOML text nest their tables.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace sonoglide::scene_file {

/// Scenes need one dot. The parser makes as many tables as a key has dots, without a bound of its
/// own, and frees them recursively: a long key would exhaust the stack.
inline constexpr int max_dots = 16;

/// Offset of the first dot beyond max_dots in one dotted name; dots in strings and comments do not
/// count. None in a text that the parser may see.
std::optional<std::size_t> find_excess_dot(std::string_view text);

}  // namespace sonoglide::scene_file
