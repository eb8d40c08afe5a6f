/// Polynomials in lanes: one polynomial at several places.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/lanes.hpp"

namespace sonoglide::numeric {

/// Coefficients, lowest power first, the same in every lane.
template <class Scalar, std::size_t Degree>
using LanePolynomial = std::array<numeric::Lanes<Scalar>, Degree + 1>;

enum class Parity : std::size_t { even, odd };

/// The even powers of p, or the odd ones over x: p(x) = even + x odd. At lanes or at a group of
/// them.
template <Parity Which, class Coefficient, std::size_t Count, class Numbers>
[[gnu::always_inline]] inline Numbers half_value(const std::array<Coefficient, Count>& p,
                                                 Numbers square) {
  constexpr auto lowest = static_cast<std::size_t>(Which);
  constexpr std::size_t highest = Count - 1 - (Count - 1 - lowest) % 2;
  static_assert(highest > lowest, "one power alone is no polynomial");
  Numbers sum = square * p[highest] + p[highest - 2];
  for (std::size_t n = highest - 2; n > lowest; n -= 2) {
    sum = sum * square + p[n - 2];
  }
  return sum;
}

/// p(x), from two halves that do not wait for each other.
template <class Coefficient, std::size_t Count, class Numbers>
[[gnu::always_inline]] inline Numbers value_at(const std::array<Coefficient, Count>& p, Numbers x) {
  const Numbers square = x * x;
  return half_value<Parity::even>(p, square) + x * half_value<Parity::odd>(p, square);
}

/// p'(x).
template <class Scalar, std::size_t Count>
[[gnu::always_inline]] inline numeric::Lanes<Scalar> rate_at(
    const std::array<numeric::Lanes<Scalar>, Count>& p, numeric::Lanes<Scalar> x) {
  const numeric::Lanes<Scalar> square = x * x;
  std::array<numeric::Lanes<Scalar>, 2> sum = {p[Count - 1] * static_cast<Scalar>(Count - 1),
                                               p[Count - 2] * static_cast<Scalar>(Count - 2)};
  for (std::size_t n = Count - 2; n-- > 1;) {
    auto& half = sum[(Count - 1 - n) % 2];
    half = half * square + p[n] * static_cast<Scalar>(n);
  }
  // The powers of p' are one below those of p.
  constexpr std::size_t even = (Count - 1) % 2 == 1 ? 0 : 1;
  return sum[even] + x * sum[1 - even];
}

}  // namespace sonoglide::numeric
