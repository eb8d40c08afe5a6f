/// How an image of a test tells a number over its byte link.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/encoding/decimal.hpp"

namespace sonoglide::image_test {

/// In decimal digits, and a character after it; waits until the link has taken them.
template <class ByteLink>
void send(ByteLink& bytes, std::uint32_t number, char end) {
  std::array<char, encoding::most_decimal_characters + 1> text{};
  const std::size_t size = encoding::write_decimal(number, 0, text.data());
  text[size] = end;
  for (std::size_t i = 0; i <= size; ++i) {
    while (!bytes.send(static_cast<std::uint8_t>(text[i]))) {
    }
  }
}

}  // namespace sonoglide::image_test
