/// Decimal numbers as text, in whole units of their last place: 450000 with six places is 0.45.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::encoding {

inline constexpr std::size_t most_decimal_characters = 11;  ///< ten digits and a point

/// Writes value * 10^-places, zeros at the end of the fraction left out.
/// @param value   in units of the last place.
/// @param places  0 … 9.
/// @param text    room for most_decimal_characters; no terminator is written.
/// @return characters written.
constexpr std::size_t write_decimal(std::uint32_t value, int places, char* text) {
  while (places > 0 && value % 10 == 0) {
    value /= 10;
    --places;
  }
  char reversed[most_decimal_characters] = {};
  std::size_t count = 0;
  for (int place = 0; place <= places || value > 0; ++place) {
    if (place == places && place > 0) {
      reversed[count++] = '.';
    }
    reversed[count++] = static_cast<char>('0' + value % 10);
    value /= 10;
  }
  for (std::size_t i = 0; i < count; ++i) {
    text[i] = reversed[count - 1 - i];
  }
  return count;
}

/// Reads a number of the form 12, 0.45, .5 or 1. into units of 10^-places.
/// @return false, and `value` as it was, for anything else: a sign, a blank, no digit, more places
///         than `places` that are not zero, more than 32 bits.
constexpr bool read_decimal(const char* text, std::size_t size, int places, std::uint32_t& value) {
  std::uint64_t sum = 0;
  bool digits = false;
  bool fraction = false;
  for (std::size_t i = 0; i < size; ++i) {
    if (text[i] == '.' && !fraction) {
      fraction = true;
      continue;
    }
    if (text[i] < '0' || text[i] > '9') {
      return false;
    }
    const auto digit = static_cast<std::uint32_t>(text[i] - '0');
    digits = true;
    if (fraction && places == 0) {
      if (digit != 0) {
        return false;
      }
      continue;
    }
    places -= fraction ? 1 : 0;
    sum = sum * 10 + digit;
    if (sum > UINT32_MAX) {
      return false;
    }
  }
  for (; places > 0 && sum <= UINT32_MAX; --places) {
    sum *= 10;
  }
  if (!digits || sum > UINT32_MAX) {
    return false;
  }
  value = static_cast<std::uint32_t>(sum);
  return true;
}

}  // namespace sonoglide::encoding
