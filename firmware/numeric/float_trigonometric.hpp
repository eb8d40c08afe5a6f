/// Sine, cosine and their inverses for float and double.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "firmware/numeric/binary_constant.hpp"
#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/float_series.hpp"
#include "firmware/numeric/float_sqrt.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::numeric {

namespace detail {

/// sin r, |r| <= pi/4.
template <class Float>
constexpr Float sine_near_zero(Float r) {
  const Float square = r * r;
  return r + r * (square * polynomial(sine_coefficients<Float>, square));
}

/// cos r, |r| <= pi/4; corrected for the rounding of 1 - r^2/2.
template <class Float>
constexpr Float cosine_near_zero(Float r) {
  const Float square = r * r;
  const Float half_square = square * static_cast<Float>(0.5);
  const Float head = Float{1} - half_square;
  const Float lost = (Float{1} - head) - half_square;
  return head + (lost + square * square * polynomial(cosine_coefficients<Float>, square));
}

/// sin(r + quarter_turns * pi/2) from the sine and cosine of r.
template <class Float>
constexpr Float in_quadrant(Float sine, Float cosine, std::uint32_t quarter_turns) {
  const Float magnitude = (quarter_turns & 1U) != 0U ? cosine : sine;
  return (quarter_turns & 2U) != 0U ? -magnitude : magnitude;
}

/// sin(r + quarter_turns * pi/2) from r. Computing both series and selecting one is quicker than a
/// branch that mispredicts.
template <class Float>
constexpr Float sine_of_quadrant(Float r, std::uint32_t quarter_turns) {
  return in_quadrant(sine_near_zero(r), cosine_near_zero(r), quarter_turns);
}

/// x - n pi/2 by Cody and Waite: pi/2 in chunks so short that their products with n are exact.
template <class Float>
constexpr Float minus_quarter_turns(Float x, Float n) {
  constexpr int chunk = is_double<Float> ? 33 : 11;
  constexpr int digits = std::numeric_limits<Float>::digits;
  constexpr Float first = bits_of<Float>(binary_pi, 1, chunk) / 2;
  constexpr Float second = bits_of<Float>(binary_pi, 1 - chunk, chunk) / 2;
  if constexpr (is_double<Float>) {
    constexpr Float third = bits_of<Float>(binary_pi, 1 - 2 * chunk, digits) / 2;
    return ((x - n * first) - n * second) - n * third;
  } else {
    constexpr Float third = bits_of<Float>(binary_pi, 1 - 2 * chunk, chunk) / 2;
    constexpr Float fourth = bits_of<Float>(binary_pi, 1 - 3 * chunk, digits) / 2;
    return (((x - n * first) - n * second) - n * third) - n * fourth;
  }
}

template <class Float>
constexpr NearestInteger<Float> nearest_quarter_turn(Float x) {
  constexpr Float quarter_turns_per_radian = static_cast<Float>(2.0 / half_turn);
  return nearest_integer(x * quarter_turns_per_radian);
}

template <class Float>
constexpr Float sine_of_shifted(Float x, std::uint32_t quarter_turns) {
  const auto n = nearest_quarter_turn(x);
  const auto quadrant = static_cast<std::uint32_t>(n.integer) + quarter_turns;
  return sine_of_quadrant(minus_quarter_turns(x, n.value), quadrant);
}

template <class Float>
constexpr Float sine_pi_of_shifted(Float x, std::uint32_t quarter_turns) {
  const auto n = nearest_integer(x + x);
  const Float rest = x - n.value * static_cast<Float>(0.5);
  const auto quadrant = static_cast<std::uint32_t>(n.integer) + quarter_turns;
  return sine_of_quadrant(rest * pi<Float>.value, quadrant);
}

/// asin s - s for |s| <= 1/2; square is s^2, a parameter because s may be its rounded root.
template <class Float>
constexpr Float arcsine_correction(Float s, Float square) {
  return s * (square * polynomial(arcsine_coefficients<Float>, square));
}

/// acos(x) / 2 = asin sqrt((1 - x) / 2), x in [1/2, 1].
template <class Float>
constexpr Float half_arccosine(Float x) {
  const Float square = (Float{1} - x) * static_cast<Float>(0.5);
  const Float s = sqrt(square);
  return s + arcsine_correction(s, square);
}

template <class Float>
inline constexpr Float inverse_pi = static_cast<Float>(1.0 / half_turn);

}  // namespace detail

/// sin(x), x in radians, |x| <= 1e6 (double) or 1e4 (float); beyond that the result has no meaning.
/// Error <= 3 ulp, next to the zeros too.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float sin(Float x) {
  return detail::sine_of_shifted(x, 0);
}

/// cos(x), x in radians, in the range of sin.
/// Error <= 3 ulp, next to the zeros too.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float cos(Float x) {
  return detail::sine_of_shifted(x, 1);
}

/// Sine and cosine of one angle.
template <class Float>
struct SineAndCosine {
  Float sine;
  Float cosine;
};

/// sin(x) and cos(x) at once, with the bits of sin and cos.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
[[gnu::always_inline]] constexpr SineAndCosine<Float> sine_and_cosine(Float x) {
  const auto n = detail::nearest_quarter_turn(x);
  const Float rest = detail::minus_quarter_turns(x, n.value);
  const auto quadrant = static_cast<std::uint32_t>(n.integer);
  const Float sine = detail::sine_near_zero(rest);
  const Float cosine = detail::cosine_near_zero(rest);
  return {detail::in_quadrant(sine, cosine, quadrant),
          detail::in_quadrant(sine, cosine, quadrant + 1U)};
}

/// sin(pi x), |x| <= 2^30 (double) or 2^21 (float); exact where the result is 0 or +-1.
/// Error <= 2.5 ulp.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float sin_pi(Float x) {
  return detail::sine_pi_of_shifted(x, 0);
}

/// cos(pi x), in the range of sin_pi and exact at the same values.
/// Error <= 2.5 ulp.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float cos_pi(Float x) {
  return detail::sine_pi_of_shifted(x, 1);
}

/// asin(x) in [-pi/2, pi/2]; NaN for |x| > 1.
/// Error <= 3 ulp.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float asin(Float x) {
  const Float magnitude = abs(x);
  if (magnitude <= static_cast<Float>(0.5)) {
    return x + detail::arcsine_correction(x, x * x);
  }
  if (!(magnitude <= Float{1})) {
    return std::numeric_limits<Float>::quiet_NaN();
  }
  const Float twice_half = twice(detail::half_arccosine(magnitude));
  const Float result = half(pi<Float>.value) - (twice_half - half(pi<Float>.rest));
  return x < Float{0} ? -result : result;
}

/// acos(x) in [0, pi]; NaN for |x| > 1.
/// Error <= 2 ulp.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float acos(Float x) {
  if (abs(x) <= static_cast<Float>(0.5)) {
    const Float correction = detail::arcsine_correction(x, x * x);
    return half(pi<Float>.value) - (x + (correction - half(pi<Float>.rest)));
  }
  if (!(abs(x) <= Float{1})) {
    return std::numeric_limits<Float>::quiet_NaN();
  }
  const Float from_axis = twice(detail::half_arccosine(abs(x)));
  return x < Float{0} ? pi<Float>.value - (from_axis - pi<Float>.rest) : from_axis;
}

/// asin(x) / pi in [-1/2, 1/2], the ends exact; NaN for |x| > 1.
/// Error <= 4 ulp.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float asin_per_pi(Float x) {
  const Float magnitude = abs(x);
  if (magnitude <= static_cast<Float>(0.5)) {
    return asin(x) * detail::inverse_pi<Float>;
  }
  if (!(magnitude <= Float{1})) {
    return std::numeric_limits<Float>::quiet_NaN();
  }
  const Float from_end = twice(detail::half_arccosine(magnitude)) * detail::inverse_pi<Float>;
  const Float result = static_cast<Float>(0.5) - from_end;
  return x < Float{0} ? -result : result;
}

}  // namespace sonoglide::numeric
