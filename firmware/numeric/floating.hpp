/// Positive numbers of any magnitude, in every scalar.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/word.hpp"

namespace sonoglide::numeric {

/// A positive number of any magnitude: itself in floating point; in fixed point a mantissa in [1/2,
/// 1) and an exponent.
template <class Scalar>
using Floating = std::conditional_t<is_fixed_point_v<Scalar>, Split<Scalar>, Scalar>;

/// x > 0 in this form; exact.
template <class Scalar>
constexpr Floating<Scalar> floating(Scalar x) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return split(x);
  } else {
    return x;
  }
}

/// floating() of an x > 0, which is not looked at: of another it is undefined in fixed point.
template <class Scalar>
constexpr Floating<Scalar> floating_positive(Scalar x) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return split_positive(x);
  } else {
    return x;
  }
}

/// A split number in this form: exact in fixed point, as scale_by_power_of_two in floating point.
template <class Scalar>
constexpr Floating<Scalar> floating(const Split<Scalar>& x) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return x;
  } else {
    return scale_by_power_of_two(x.mantissa, x.exponent);
  }
}

/// a b, rounded by IEEE-754.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float product(Float a, Float b) {
  return a * b;
}

/// a / b, rounded by IEEE-754.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float quotient(Float a, Float b) {
  return a / b;
}

/// a b, rounded once.
template <class Overflow>
constexpr Split<Q31<Overflow>> product(const Split<Q31<Overflow>>& a,
                                       const Split<Q31<Overflow>>& b) {
  constexpr std::int32_t one_half = 1 << 30;
  const std::int32_t mantissa = rounded_q31_product(a.mantissa.raw(), b.mantissa.raw());
  const int exponent = a.exponent + b.exponent;
  return mantissa < one_half
             ? Split<Q31<Overflow>>{Q31<Overflow>::from_raw(2 * mantissa), exponent - 1}
             : Split<Q31<Overflow>>{Q31<Overflow>::from_raw(mantissa), exponent};
}

/// a b, too small by at most 2^-14 of it.
template <class Overflow>
constexpr Split<Q15<Overflow>> product(const Split<Q15<Overflow>>& a,
                                       const Split<Q15<Overflow>>& b) {
  const std::int32_t mantissa = std::int32_t{a.mantissa.raw()} * b.mantissa.raw();
  const bool below_half = mantissa < 1 << 29;
  const auto raw = static_cast<std::int16_t>(mantissa >> (below_half ? 14 : 15));
  const int exponent = a.exponent + b.exponent;
  return {Q15<Overflow>::from_raw(raw), below_half ? exponent - 1 : exponent};
}

/// f 2^n: in floating point as scale_by_power_of_two, in fixed point exact.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float rescaled(Float f, int n) {
  return scale_by_power_of_two(f, n);
}
template <class Scalar>
constexpr Split<Scalar> rescaled(const Split<Scalar>& f, int n) {
  return {f.mantissa, f.exponent + n};
}

/// x f, f of any magnitude. In floating point rounded by IEEE-754.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float limited_product(Float x, Float f) {
  return x * f;
}

/// x f, f of any magnitude. Where f < 1 too small by less than two units of the last place, else the
/// mantissa's product rounded and shifted; limited to [-1, 1), which is not an overflow.
template <class Overflow>
constexpr Q31<Overflow> limited_product(Q31<Overflow> x, const Split<Q31<Overflow>>& f) {
  if (f.exponent < 0) {
    const std::int32_t part = high_word(x.raw(), f.mantissa.raw());
    return Q31<Overflow>::from_raw(part >> min(-1 - f.exponent, 31));
  }
  const std::int32_t part = rounded_q31_product(x.raw(), f.mantissa.raw());
  return lifted(Q31<Overflow>::from_raw(part), min(f.exponent, 31));
}

namespace detail {

/// mantissa 2^up
template <class Scalar>
struct FixedMultiple {
  Scalar mantissa;
  int up;
};

}  // namespace detail

/// A factor of at least 1/2, ready for product after product; itself in floating point.
template <class Scalar>
using Multiple =
    std::conditional_t<is_fixed_point_v<Scalar>, detail::FixedMultiple<Scalar>, Scalar>;

template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float multiple(Float f) {
  return f;
}
/// f >= 1/2, its exponent limited to 30.
template <class Scalar>
constexpr detail::FixedMultiple<Scalar> multiple(const Split<Scalar>& f) {
  return {f.mantissa, min(f.exponent, 30)};
}

template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float multiplied(Float x, Float multiple) {
  return x * multiple;
}
/// x f, too small by less than 2^(up + 1) units of the last place; limited to [-1, 1), which is not
/// an overflow.
template <class Overflow>
constexpr Q31<Overflow> multiplied(Q31<Overflow> x, const detail::FixedMultiple<Q31<Overflow>>& f) {
  return lifted(half_product(x, f.mantissa), f.up + 1);
}

/// f itself; in fixed point rounded down to a unit of the last place and limited to below 1.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float limited_value(Float f) {
  return f;
}
template <class Scalar>
constexpr Scalar limited_value(const Split<Scalar>& f) {
  using Raw = typename Scalar::Raw;
  return f.exponent > 0
             ? Scalar::largest()
             : Scalar::from_raw(static_cast<Raw>(f.mantissa.raw() >> min(-f.exponent, 31)));
}

namespace detail {

/// n/d, 2^30 <= n, d < 2^31, with 28 fraction bits; too small by at most 2^-24.
///
/// Long division by two digits of 12 and 16 bits, each from a reciprocal of 15 bits. So every
/// product fits a word; on small processors a wide product or a division is a call.
constexpr std::uint32_t mantissa_quotient(std::uint32_t n, std::uint32_t d) {
  const std::uint32_t leading = (d >> 15) + 1;        // 1/2 to 1 with 16 bits, and not too small
  const std::uint32_t inverse = reciprocal(leading);  // 15 fraction bits
  const std::uint32_t first = ((n >> 16) * inverse) >> 18;
  const std::uint32_t rest = (n << 12) - first * d;  // below 2 d, though n << 12 wraps
  return (first << 16) + (((rest >> 16) * inverse) >> 14);
}

}  // namespace detail

/// a/b, too small by at most 2^-23 of it.
template <class Overflow>
constexpr Split<Q31<Overflow>> quotient(const Split<Q31<Overflow>>& a,
                                        const Split<Q31<Overflow>>& b) {
  const std::uint32_t mantissa = detail::mantissa_quotient(
      static_cast<std::uint32_t>(a.mantissa.raw()), static_cast<std::uint32_t>(b.mantissa.raw()));
  const int exponent = a.exponent - b.exponent;
  const bool below_one = mantissa < 1U << 28;
  return {Q31<Overflow>::from_raw(static_cast<std::int32_t>(mantissa << (below_one ? 3 : 2))),
          below_one ? exponent : exponent + 1};
}

/// a/b, too small by at most 2^-13 of it.
template <class Overflow>
constexpr Split<Q15<Overflow>> quotient(const Split<Q15<Overflow>>& a,
                                        const Split<Q15<Overflow>>& b) {
  const std::uint32_t mantissa =
      detail::mantissa_quotient(static_cast<std::uint32_t>(a.mantissa.raw()) << 16,
                                static_cast<std::uint32_t>(b.mantissa.raw()) << 16);
  const int exponent = a.exponent - b.exponent;
  const bool below_one = mantissa < 1U << 28;
  return {Q15<Overflow>::from_raw(static_cast<std::int16_t>(mantissa >> (below_one ? 13 : 14))),
          below_one ? exponent : exponent + 1};
}

}  // namespace sonoglide::numeric
