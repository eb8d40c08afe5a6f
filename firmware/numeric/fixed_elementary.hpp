/// Elementary functions of Q31 and Q15 in integer arithmetic alone.
///
/// Error bounds are in units of the last place (LSB) of the result's format, over every argument. A
/// result of +1, which the format lacks, is given as the largest value: that is within the bound
/// and not an overflow.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "firmware/numeric/binary_constant.hpp"
#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/float_exponential.hpp"
#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/float_series.hpp"
#include "firmware/numeric/integer_root.hpp"

namespace sonoglide::numeric {

// Polynomials in integer arithmetic, every coefficient in the finest format that its size allows.

/// Sum of c[k] z^k for |z| <= 1, z with 31 fraction bits, by Horner's rule.
///
/// The partial sum from term k on has as many fraction bits as fit into 31 bits and a sign. So the
/// small first sums are rounded finely, and the rounding of the last sum dominates.
/// @tparam Wide  type of the products; with std::int32_t, z and the partial sums have 15 bits, not
///               31.
template <std::size_t Terms, class Wide = std::int64_t>
class FixedPolynomial {
 public:
  /// At compile time: it takes double.
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

  /// At compile time.
  static constexpr double abs_of(double x) { return x < 0.0 ? -x : x; }

  /// Fraction bits that leave a magnitude of up to `bound` below 2^digits.
  /// At compile time.
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

namespace detail {

/// (pi/4)^(first + 2k) (-1)^k / (first + 2k)!: the series of sin(pi/4 t) / t and cos(pi/4 t) in
/// t^2.
/// At compile time.
template <std::size_t Terms>
constexpr std::array<double, Terms> eighth_turn_series(int first) {
  constexpr double angle = pi<double>.value / 4.0;
  std::array<double, Terms> result{};
  double term = first == 0 ? 1.0 : angle;
  for (std::size_t k = 0; k < Terms; ++k) {
    result[k] = term;
    const int next = first + 2 * static_cast<int>(k) + 1;
    term *= -angle * angle / (static_cast<double>(next) * (next + 1));
  }
  return result;
}

/// exp(-1/2) / (2^k k!): the series of exp((w - 1) / 2) in w.
/// At compile time.
template <std::size_t Terms>
constexpr std::array<double, Terms> centred_exponential_series() {
  std::array<double, Terms> result{};
  double term = exp(-0.5);
  for (std::size_t k = 0; k < Terms; ++k) {
    result[k] = term;
    term /= 2.0 * static_cast<double>(k + 1);
  }
  return result;
}

/// The series of asin(t / 2) / (pi t) in t^2.
/// At compile time.
template <std::size_t Terms>
constexpr std::array<double, Terms> half_arcsine_series() {
  constexpr auto arcsine = arcsine_series<double, Terms - 1>();
  std::array<double, Terms> result{};
  double scale = 1.0 / (2.0 * pi<double>.value);
  result[0] = scale;
  for (std::size_t k = 1; k < Terms; ++k) {
    scale /= 4.0;
    result[k] = scale * arcsine[k - 1];
  }
  return result;
}

// Terms: the first one left out is below a tenth of a Q31 LSB.
inline constexpr FixedPolynomial<6> eighth_turn_sine{eighth_turn_series<6>(1), 32};
inline constexpr FixedPolynomial<7> eighth_turn_cosine{eighth_turn_series<7>(0), 40};
inline constexpr FixedPolynomial<4, std::int32_t> short_eighth_turn_sine{eighth_turn_series<4>(1),
                                                                         16};
inline constexpr FixedPolynomial<5, std::int32_t> short_eighth_turn_cosine{eighth_turn_series<5>(0),
                                                                           24};
inline constexpr FixedPolynomial<11> centred_exponential{centred_exponential_series<11>(), 40};
inline constexpr FixedPolynomial<14> half_arcsine{half_arcsine_series<14>(), 34};

constexpr std::int64_t q31_square(std::int64_t x) {
  return shift_right_rounded(x * x, 31);
}

/// sin(pi x + quarter_turns pi/2); x and the result, in [-1, 1], with 31 fraction bits.
constexpr std::int64_t q31_sine(std::int64_t x, unsigned quarter_turns) {
  const auto angle = static_cast<std::uint32_t>(x);
  const std::uint32_t nearest = (angle + (1U << 29)) >> 30;
  const auto rest = static_cast<std::int32_t>(angle - (nearest << 30));
  const std::int64_t t = (rest < 0 ? -std::int64_t{rest} : std::int64_t{rest}) * 4;
  const unsigned quadrant = nearest + quarter_turns;
  const bool flipped = (quadrant & 2U) != 0U;
  if ((quadrant & 1U) != 0U) {
    const std::int64_t cosine = shift_right_rounded(eighth_turn_cosine(q31_square(t)), 9);
    return flipped ? -cosine : cosine;
  }
  const std::int64_t sine = shift_right_rounded(t * eighth_turn_sine(q31_square(t)), 32);
  return flipped != (rest < 0) ? -sine : sine;
}

/// sin(pi x + quarter_turns pi/2) with 15 fraction bits, for which 32-bit products suffice.
constexpr std::int32_t q15_sine(std::int32_t x, unsigned quarter_turns) {
  const auto angle = static_cast<std::uint16_t>(x);
  const unsigned nearest = (angle + (1U << 13)) >> 14;
  const auto rest = static_cast<std::int16_t>(angle - (nearest << 14));
  const std::int32_t t = (rest < 0 ? -rest : rest) * 4;
  const std::int32_t z = shift_right_rounded(t * t, 15);
  const unsigned quadrant = nearest + quarter_turns;
  const bool flipped = (quadrant & 2U) != 0U;
  if ((quadrant & 1U) != 0U) {
    const std::int32_t cosine = shift_right_rounded(short_eighth_turn_cosine(z), 9);
    return flipped ? -cosine : cosine;
  }
  const std::int32_t sine = shift_right_rounded(t * short_eighth_turn_sine(z), 16);
  return flipped != (rest < 0) ? -sine : sine;
}

/// asin(x) / pi, x in [-1, 1), both with 31 fraction bits.
constexpr std::int64_t q31_arcsine(std::int64_t x) {
  constexpr std::int64_t one_half = std::int64_t{1} << 30;
  const std::int64_t magnitude = x < 0 ? -x : x;
  std::int64_t result = 0;
  if (magnitude <= one_half) {
    const std::int64_t t = 2 * magnitude;
    result = shift_right_rounded(t * half_arcsine(q31_square(t)), 34);
  } else {
    // asin x = pi/2 - 2 asin s, s = sqrt((1 - x) / 2); s with 32 fraction bits is 2 s with 31.
    const auto complement = static_cast<std::uint64_t>(2 * one_half - magnitude);
    const auto t = static_cast<std::int64_t>(nearest_root(complement << 32));
    result = one_half - shift_right_rounded(t * half_arcsine(q31_square(t)), 33);
  }
  return x < 0 ? -result : result;
}

/// exp(x), x in [-1, 0], both with 31 fraction bits.
constexpr std::int64_t q31_exponential(std::int64_t x) {
  constexpr std::int64_t one = std::int64_t{1} << 31;
  return shift_right_rounded(centred_exponential(2 * x + one), 9);
}

/// A number in [-1, 1) as an integer with 31 fraction bits.
template <class Number>
constexpr std::int64_t to_q31(Number x) {
  static_assert(Number::fraction_bits == std::numeric_limits<typename Number::Raw>::digits,
                "the range must be [-1, 1)");
  return std::int64_t{x.raw()} * (std::int64_t{1} << (31 - Number::fraction_bits));
}

/// A raw result in [-1, 1] as a number; +1 becomes the largest value.
template <class Number, class Integer>
constexpr Number from_result(Integer raw) {
  constexpr Integer largest = std::numeric_limits<typename Number::Raw>::max();
  return Number::from_raw(static_cast<typename Number::Raw>(raw < largest ? raw : largest));
}

/// A result in [-1, 1] with 31 fraction bits as a number.
template <class Number>
constexpr Number from_q31(std::int64_t result) {
  return from_result<Number>(shift_right_rounded(result, 31 - Number::fraction_bits));
}

/// sin(pi x + quarter_turns pi/2).
template <class Number>
constexpr Number sine(Number x, unsigned quarter_turns) {
  if constexpr (std::is_same_v<typename Number::Raw, std::int16_t>) {
    static_assert(Number::fraction_bits == 15, "the range must be [-1, 1)");
    return from_result<Number>(q15_sine(x.raw(), quarter_turns));
  } else {
    return from_q31<Number>(q31_sine(to_q31(x), quarter_turns));
  }
}

}  // namespace detail

/// sin(pi x): the raw value is the angle, its full range the full circle. Never overflows.
/// Error <= 1 LSB in Q31 and in Q15.
template <class Storage, int FractionBits, class Overflow>
constexpr Fixed<Storage, FractionBits, Overflow> sin_pi(Fixed<Storage, FractionBits, Overflow> x) {
  return detail::sine(x, 0);
}

/// cos(pi x): as sin_pi.
/// Error <= 1 LSB in Q31 and in Q15.
template <class Storage, int FractionBits, class Overflow>
constexpr Fixed<Storage, FractionBits, Overflow> cos_pi(Fixed<Storage, FractionBits, Overflow> x) {
  return detail::sine(x, 1);
}

/// asin(x) / pi in [-1/2, 1/2]: the inverse of sin_pi. Never overflows.
/// Error <= 1 LSB in Q31 and in Q15.
template <class Storage, int FractionBits, class Overflow>
constexpr Fixed<Storage, FractionBits, Overflow> asin_per_pi(
    Fixed<Storage, FractionBits, Overflow> x) {
  return detail::from_q31<decltype(x)>(detail::q31_arcsine(detail::to_q31(x)));
}

/// exp(x) in (0.367, 1] for x in [-1, 0]; x > 0 overflows.
/// Error <= 1 LSB in Q31 and in Q15.
template <class Storage, int FractionBits, class Overflow>
constexpr Fixed<Storage, FractionBits, Overflow> exp(Fixed<Storage, FractionBits, Overflow> x) {
  if (x.raw() > 0) {
    Overflow::on_overflow();
    return decltype(x)::largest();
  }
  return detail::from_q31<decltype(x)>(detail::q31_exponential(detail::to_q31(x)));
}

/// sqrt(x) in [0, 1); x < 0 overflows and gives 0.
/// Error <= 1/2 LSB in Q31, 0.501 LSB in Q15.
template <class Storage, int FractionBits, class Overflow>
constexpr Fixed<Storage, FractionBits, Overflow> sqrt(Fixed<Storage, FractionBits, Overflow> x) {
  if (x.raw() < 0) {
    Overflow::on_overflow();
    return {};
  }
  const auto square = static_cast<std::uint64_t>(detail::to_q31(x)) << 31;
  return detail::from_q31<decltype(x)>(static_cast<std::int64_t>(nearest_root(square)));
}

}  // namespace sonoglide::numeric
