/// The end of an ideal converter's range.
#pragma once

#include <cstdint>

namespace sonoglide::hal::simulated {

/// Whether a converter of 32 bits that gives this code stands at either end.
constexpr bool at_rail(std::int32_t code) {
  return code == INT32_MAX || code == INT32_MIN;
}

}  // namespace sonoglide::hal::simulated
