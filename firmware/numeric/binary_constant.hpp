/// Mathematical constants to more digits than any float holds, cut into exact floating-point parts.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/numeric/float_format.hpp"

namespace sonoglide::numeric {

/// An integer part and 128 bits of fraction, most significant word first.
using BinaryConstant = std::array<std::uint32_t, 5>;

/// The circle constant and the natural logarithm of two, as their hexadecimal expansions.
inline constexpr BinaryConstant binary_pi{0x3, 0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344};
inline constexpr BinaryConstant binary_ln2{0x0, 0xB17217F7, 0xD1CF79AB, 0xC9E3B398, 0x03F2F6AF};

/// Sum of the bits of the constant from weight 2^top down, `count` of them; exact in Float.
/// At compile time.
template <class Float>
constexpr Float bits_of(const BinaryConstant& constant, int top, int count) {
  Float sum = 0;
  for (int weight = top; weight > top - count; --weight) {
    const int position = 31 - weight;  // from the most significant bit of the integer word
    const auto word = constant[static_cast<std::size_t>(position / 32)];
    if (((word >> (31 - position % 32)) & 1U) != 0U) {
      sum += power_of_two<Float>(weight);
    }
  }
  return sum;
}

/// The Float nearest to a constant, and the error of that: value + rest has twice the digits.
template <class Float>
struct NearestConstant {
  Float value;
  Float rest;
};

/// At compile time.
/// @param constant  its bits, the leading one first.
/// @param top       weight of the constant's leading bit.
template <class Float>
constexpr NearestConstant<Float> nearest_constant(const BinaryConstant& constant, int top) {
  constexpr int digits = std::numeric_limits<Float>::digits;
  const Float high = bits_of<Float>(constant, top, digits);
  const Float low = bits_of<Float>(constant, top - digits, digits);
  const Float nearest = high + low;
  return {nearest, (high - nearest) + low};
}

template <class Float>
inline constexpr NearestConstant<Float> pi = nearest_constant<Float>(binary_pi, 1);
template <class Float>
inline constexpr NearestConstant<Float> ln2 = nearest_constant<Float>(binary_ln2, -1);

}  // namespace sonoglide::numeric
