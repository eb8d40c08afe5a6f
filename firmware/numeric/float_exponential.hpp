/// Exponentials and the binary logarithm of float and double.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "firmware/numeric/binary_constant.hpp"
#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/float_series.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric {

namespace detail {

/// exp(r + tail) - 1 for |r| <= ln(2)/2 and a tail below its last digit.
template <class Float>
constexpr Float exponential_minus_one_near_zero(Float r, Float tail) {
  return r + (r * r * polynomial(exponential_coefficients<Float>, r) + tail);
}

/// x = n ln 2 + rest + tail, |rest| <= ln(2)/2.
template <class Float>
struct ExponentialArgument {
  Float rest;
  Float tail;
  std::int32_t n;
};

template <class Float>
constexpr ExponentialArgument<Float> reduce_exponential(Float x) {
  constexpr int chunk = is_double<Float> ? 41 : 15;  // times n, |n| < 2^11 or 2^8, is exact
  constexpr Float first = bits_of<Float>(binary_ln2, -1, chunk);
  constexpr Float second =
      bits_of<Float>(binary_ln2, -1 - chunk, std::numeric_limits<Float>::digits);
  const auto n = nearest_integer(x * static_cast<Float>(1.44269504088896340736));
  const Float high = x - n.value * first;
  const Float low = n.value * second;
  const Float rest = high - low;
  return {rest, (high - rest) - low, n.integer};
}

/// Beyond these ends exp is infinity or 0 in the format, so the argument may be cut off there.
template <class Float>
inline constexpr Float exponential_high = is_double<Float> ? Float{720} : Float{90};
template <class Float>
inline constexpr Float exponential_low = is_double<Float> ? Float{-760} : Float{-110};

/// (1 + p) 2^n; scaling in two halves reaches both ends of the format and rounds once.
template <class Float>
constexpr Float scale_exponential(Float p, std::int32_t n) {
  const std::int32_t first_half = n / 2;
  return (Float{1} + p) * power_of_two<Float>(first_half) * power_of_two<Float>(n - first_half);
}

}  // namespace detail

/// exp(x): 0 and infinity past the ends of the format, subnormals included.
/// Error <= 1 ulp.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float exp(Float x) {
  const Float inside = clamp(x, detail::exponential_low<Float>, detail::exponential_high<Float>);
  const auto argument = detail::reduce_exponential(inside);
  return detail::scale_exponential(
      detail::exponential_minus_one_near_zero(argument.rest, argument.tail), argument.n);
}

/// exp(x) - 1, near 0 without cancellation.
/// Error <= 2 ulp.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float expm1(Float x) {
  constexpr Float minus_one_below = Float{-40};
  const Float inside = clamp(x, minus_one_below, detail::exponential_high<Float>);
  const auto argument = detail::reduce_exponential(inside);
  const Float p = detail::exponential_minus_one_near_zero(argument.rest, argument.tail);
  // p 2^n + (2^n - 1), with a half of the power of two taken out so that neither term overflows.
  const std::int32_t first_half = argument.n / 2;
  const std::int32_t second_half = argument.n - first_half;
  const Float outer = power_of_two<Float>(second_half);
  const Float inner = power_of_two<Float>(first_half);
  return (p * inner + (inner - power_of_two<Float>(-second_half))) * outer;
}

/// 2^x: 0 and infinity past the ends of the format, subnormals included; exact for integers.
/// Error <= 1.5 ulp.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float exp2(Float x) {
  constexpr Float high = detail::is_double<Float> ? Float{1040} : Float{135};
  constexpr Float low = detail::is_double<Float> ? Float{-1090} : Float{-160};
  const Float inside = clamp(x, low, high);
  const auto n = nearest_integer(inside);
  const Float rest = (inside - n.value) * ln2<Float>.value;
  return detail::scale_exponential(detail::exponential_minus_one_near_zero(rest, Float{0}),
                                   n.integer);
}

/// log2(x): -infinity for 0, NaN for x < 0; exact for powers of two.
/// Error <= 2 ulp.
///
/// With x = m 2^e, m in [sqrt(1/2), sqrt(2)), f = m - 1 and s = f / (2 + f):
/// log(1 + f) = f - f^2/2 + s (f^2/2 + s^2 (2/3 + 2/5 s^2 + ...)).
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float log2(Float x) {
  using Limits = std::numeric_limits<Float>;
  if (!(x > Float{0}) || !is_finite(x)) {
    if (x == Float{0}) {
      return -Limits::infinity();
    }
    return x < Float{0} ? Limits::quiet_NaN() : x;
  }
  const auto parts = split(x);
  const bool low = parts.mantissa < static_cast<Float>(0.70710678118654752440);
  const Float f = (low ? twice(parts.mantissa) : parts.mantissa) - Float{1};
  const int exponent = low ? parts.exponent - 1 : parts.exponent;
  const Float s = f / (Float{2} + f);
  const Float square = s * s;
  const Float tail = square * polynomial(detail::logarithm_coefficients<Float>, square);
  const Float half_square = half(f * f);
  const Float logarithm = f - (half_square - s * (half_square + tail));
  return static_cast<Float>(exponent) + logarithm * static_cast<Float>(1.44269504088896340736);
}

}  // namespace sonoglide::numeric
