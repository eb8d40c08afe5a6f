/// Whole numbers from bytes, the lowest first, on a machine of any byte order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace sonoglide::encoding {

/// The number in the first sizeof(Integer) bytes.
template <class Integer>
constexpr Integer get_little_endian(const std::uint8_t* bytes) {
  std::uint32_t value = 0;
  static_assert(sizeof(Integer) <= sizeof value);
  for (std::size_t i = sizeof(Integer); i > 0; --i) {
    value = value << 8 | bytes[i - 1];
  }
  return static_cast<Integer>(value);
}

}  // namespace sonoglide::encoding
