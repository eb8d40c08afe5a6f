/// Polynomials on [-1, 1], shortened.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric {

/// Economises the power series p on [-1, 1]: removes its highest powers one after the other. Each
/// is replaced by the lower powers that differ from it by a multiple of a Chebyshev polynomial.
///
/// Returns a bound of the change: the sum of |p[n]| 2^(1-n) over the removed powers.
/// Source: C. Lanczos, Applied Analysis, 1956 (economization of power series).
template <class Scalar, std::size_t Long, std::size_t Short>
Scalar economise(std::array<Scalar, Long> p, std::array<Scalar, Short>& shortened) {
  static_assert(Short <= Long && Short > 1, "fewer terms, but more than one");
  Scalar lost = Scalar(0);
  for (std::size_t n = Long - 1; n >= Short; --n) {
    lost += numeric::abs(p[n]) * numeric::power_of_two<Scalar>(1 - static_cast<int>(n));
    // T_n / 2^(n-1) = x^n - n / 4 x^(n-2) + ...
    Scalar part = p[n];
    for (std::size_t k = 0; n >= 2 * k + 2; ++k) {
      const std::size_t power = n - 2 * k;
      part *= -static_cast<Scalar>(power * (power - 1)) /
              static_cast<Scalar>(4 * (k + 1) * (n - k - 1));
      p[power - 2] -= part;
    }
  }
  for (std::size_t n = 0; n < Short; ++n) {
    shortened[n] = p[n];
  }
  return lost;
}

}  // namespace sonoglide::numeric
