/// Polynomials in integer arithmetic, every coefficient in the finest format that its size allows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/float_format.hpp"

namespace sonoglide::numeric {

/// Sum of c[k] z^k for |z| <= 1, z with 31 fraction bits, by Horner's rule.
///
/// The partial sum from term k on has as many fraction bits as fit into 31 bits and a sign. So the
/// small first sums are rounded finely, and the rounding of the last sum dominates.
/// @tparam Wide  type of the products; with std::int32_t, z and the partial sums have 15 bits, not
///               31.
template <std::size_t Terms, class Wide = std::int64_t>
class FixedPolynomial {
 public:
  /// @param coefficients   c[0] first.
  /// @param fraction_bits  of the result, which may use all of Wide.
  constexpr FixedPolynomial(const std::array<double, Terms>& coefficients, int fraction_bits) {
    double bound = 0.0;
    int bits_after = 0;
    for (std::size_t k = Terms; k-- > 0;) {
      bound += abs_of(coefficients[k]);
      const int bits = k == 0 ? fraction_bits : finest_format(bound);
      coefficients_[k] = round_half_up<Wide>(coefficients[k] * power_of_two<double>(bits));
      shifts_[k] = digits + bits_after - bits;
      bits_after = bits;
    }
  }

  constexpr Wide operator()(Wide z) const {
    Wide sum = coefficients_[Terms - 1];
    for (std::size_t k = Terms - 1; k-- > 0;) {
      sum = coefficients_[k] + shift_right_rounded(z * sum, shifts_[k]);
    }
    return sum;
  }

 private:
  static constexpr int digits = std::numeric_limits<Wide>::digits / 2;

  static constexpr double abs_of(double x) { return x < 0.0 ? -x : x; }

  /// Fraction bits that leave a magnitude of up to `bound` below 2^digits.
  static constexpr int finest_format(double bound) {
    int bits = 0;
    while (bound * power_of_two<double>(bits + 1) < power_of_two<double>(digits)) {
      ++bits;
    }
    return bits;
  }

  std::array<Wide, Terms> coefficients_{};
  std::array<int, Terms> shifts_{};
};

}  // namespace sonoglide::numeric
