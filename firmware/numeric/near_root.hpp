/// Roots that are nearly rounded, for what needs them quickly.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/float_sqrt.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/word.hpp"

namespace sonoglide::numeric {

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

/// sqrt(x), x >= 0, rounded by IEEE-754.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
Float near_root(Float x) {
  return quick_sqrt(x);
}

/// sqrt(x), x >= 0. Error: 2^-23 of it and a unit of the last place.
template <class Overflow>
constexpr Q31<Overflow> near_root(Q31<Overflow> x) {
  if (x.raw() <= 0) {
    return {};
  }
  const int shift = (__builtin_clz(static_cast<std::uint32_t>(x.raw())) - 1) & ~1;
  const std::uint32_t leading = static_cast<std::uint32_t>(x.raw()) << (shift + 1);
  // Below the true one, so that the root stays below 1.
  const std::uint32_t inverse = near_inverse_root_of_bits(leading) - 32;
  const std::uint32_t root = high_word(leading, inverse) << 1;
  return Q31<Overflow>::from_raw(static_cast<std::int32_t>(root >> (shift / 2)));
}

}  // namespace sonoglide::numeric
