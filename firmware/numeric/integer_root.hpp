/// Square root of an integer.
#pragma once

#include <cstdint>

namespace sonoglide::numeric {

/// The integer nearest to sqrt(n), n < 2^62; exact.
///
/// Newton's iteration for 1/sqrt needs no division; the exact residual then settles the last
/// digits.
constexpr std::uint64_t nearest_root(std::uint64_t n) {
  if (n == 0) {
    return 0;
  }
  const int shift = __builtin_clzll(n) & ~1;
  const std::uint64_t leading = (n << shift) >> 32;  // in [1/4, 1) with 32 fraction bits
  constexpr std::uint64_t three = std::uint64_t{3} << 30;
  // 2.21 - 1.27 m is within 9 % of 1/sqrt(m); 30 fraction bits from here on.
  constexpr std::uint64_t intercept = (std::uint64_t{221} << 30) / 100;
  constexpr std::uint64_t slope = (std::uint64_t{127} << 30) / 100;
  std::uint64_t inverse = intercept - ((slope * leading) >> 32);
  for (int i = 0; i < 4; ++i) {
    const std::uint64_t square = (inverse * inverse) >> 30;
    inverse = (inverse * (three - ((leading * square) >> 32))) >> 31;
  }
  std::uint64_t root = ((leading * inverse) >> 30) >> (shift / 2);
  while (root * root > n) {
    --root;
  }
  while (n - root * root > 2 * root) {
    ++root;
  }
  return n - root * root > root ? root + 1 : root;
}

}  // namespace sonoglide::numeric
