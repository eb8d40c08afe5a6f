/// Roots that are nearly rounded, for what needs them quickly.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/word.hpp"

namespace sonoglide::numeric {

/// 1/sqrt(x), x > 0 and normal, within 2 units of the last place.
///
/// The bits of a floating-point number, read as an integer, are nearly its logarithm: half of their
/// distance from the bits of 1, turned round, is within 4 % of the result. Each step of Newton's
/// iteration squares that.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float near_inverse_root(Float x) {
  using Bits = FloatBits<Float>;
  constexpr Bits one = to_bits(Float(1));
  constexpr auto least_error = static_cast<Bits>(
      static_cast<Float>(0.045) * power_of_two<Float>(FloatFormat<Float>::fraction_bits));
  Float root = from_bits<Float>(one + one / 2 - least_error - to_bits(x) / 2);
  const Float half_x = half(x);
  // Written out, as a loop of so few steps is slower on small processors.
  const auto improved = [half_x](Float y) {
    return y * (static_cast<Float>(1.5) - half_x * y * y);
  };
  root = improved(improved(improved(root)));
  if constexpr (std::is_same_v<Float, double>) {
    root = improved(improved(root));
  }
  return root;
}

/// 1/sqrt(m) with 30 fraction bits, m in [1/4, 1) with 32; within 2^-23.5 of it.
constexpr std::uint32_t near_inverse_root_of_bits(std::uint32_t m) {
  constexpr std::uint32_t three = std::uint32_t{3} << 28;
  // 2.15 - 1.24 m is within 9.1 % of 1/sqrt(m).
  constexpr auto intercept = static_cast<std::uint32_t>((std::uint64_t{215} << 30) / 100);
  constexpr auto slope = static_cast<std::uint32_t>((std::uint64_t{124} << 30) / 100);
  const auto improved = [m](std::uint32_t inverse) {
    const std::uint32_t square = high_word(m, high_word(inverse, inverse));  // 28 fraction bits
    return high_word(inverse, (three - square) << 2) << 1;
  };
  return improved(improved(improved(intercept - high_word(slope, m))));
}

/// sqrt(x), x >= 0; 0 below the normal numbers. Error: 3 units of the last place.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float near_root(Float x) {
  return x < std::numeric_limits<Float>::min() ? Float(0) : x * near_inverse_root(x);
}

/// sqrt(x), x >= 0. Error: 2^-23 of it and a unit of the last place.
template <class Overflow>
constexpr Q31<Overflow> near_root(Q31<Overflow> x) {
  if (x.raw() <= 0) {
    return {};
  }
  const int shift = (__builtin_clz(static_cast<std::uint32_t>(x.raw())) - 1) & ~1;
  const std::uint32_t leading = static_cast<std::uint32_t>(x.raw()) << (shift + 1);
  const std::uint64_t root =
      (std::uint64_t{leading} * near_inverse_root_of_bits(leading)) >> (31 + shift / 2);
  return Q31<Overflow>::from_raw(static_cast<std::int32_t>(min<std::uint64_t>(root, INT32_MAX)));
}

}  // namespace sonoglide::numeric
