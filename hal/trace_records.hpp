/// How many steps a unit's trace keeps on a board.
#pragma once

#include <cstddef>
#include <type_traits>

namespace sonoglide::hal {

/// None, unless the board's hardware says how many. Each takes 20 or 24 bytes of RAM:
///
///     static constexpr std::size_t trace_records = 1024;
template <class Hardware, class = void>
inline constexpr std::size_t trace_records = 0;
template <class Hardware>
inline constexpr std::size_t
    trace_records<Hardware, std::void_t<decltype(Hardware::trace_records)>> =
        Hardware::trace_records;

}  // namespace sonoglide::hal
