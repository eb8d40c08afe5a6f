/// Evaluation of polynomials whose coefficients are known at compile time.
#pragma once

#include <array>
#include <cstddef>

namespace sonoglide::numeric {

/// Sum of coefficients[k] * x^k: even and odd powers are two independent Horner chains.
template <class Float, std::size_t Terms>
constexpr Float polynomial(const std::array<Float, Terms>& coefficients, Float x) {
  static_assert(Terms % 2 == 0, "the two chains are of equal length");
  const Float square = x * x;
  Float even = coefficients[Terms - 2];
  Float odd = coefficients[Terms - 1];
  for (std::size_t pair = Terms / 2 - 1; pair-- > 0;) {
    even = even * square + coefficients[2 * pair];
    odd = odd * square + coefficients[2 * pair + 1];
  }
  return even + x * odd;
}

}  // namespace sonoglide::numeric
