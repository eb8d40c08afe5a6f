/// Square root of float and double.
#pragma once

#include <limits>
#include <type_traits>

#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric {

/// sqrt(x); NaN for x < 0.
/// Correctly rounded: the bits of an IEEE-754 square root.
///
/// Newton's iteration from the chord of [1, 4), then the exact integer residual decides the last
/// bit.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float sqrt(Float x) {
  using Bits = FloatBits<Float>;
  using SignedBits = std::make_signed_t<Bits>;
  constexpr int fraction_bits = FloatFormat<Float>::fraction_bits;
  constexpr Float one = power_of_two<Float>(fraction_bits);
  if (!(x > Float{0}) || !is_finite(x)) {
    return x < Float{0} ? std::numeric_limits<Float>::quiet_NaN() : x;
  }
  const auto parts = split(x);
  const int lift = (parts.exponent & 1) != 0 ? 1 : 2;  // leaves an even exponent
  const Float reduced = parts.mantissa * power_of_two<Float>(lift);
  Float root = reduced / 3 + Float{17} / Float{24};  // within 4.2 %
  constexpr int iterations = std::is_same_v<Float, double> ? 4 : 3;
  for (int i = 0; i < iterations; ++i) {
    root = (root + reduced / root) * static_cast<Float>(0.5);
  }
  // |residual| < 2^(fraction_bits + 3): the wrapped difference of the wide squares is exact.
  const auto square = static_cast<Bits>(static_cast<Bits>(reduced * one) << fraction_bits);
  auto candidate = static_cast<Bits>(root * one);
  const auto residual = static_cast<SignedBits>(square - candidate * candidate);
  const auto bound = static_cast<SignedBits>(candidate);
  candidate += residual > bound ? 1U : 0U;
  candidate -= residual <= -bound ? 1U : 0U;
  const int exponent = (parts.exponent - lift) / 2;
  return static_cast<Float>(candidate) * power_of_two<Float>(exponent - fraction_bits);
}

/// sqrt(x), x >= 0, with the same bits by an instruction where the processor has one.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
Float quick_sqrt(Float x) {
#if defined(__ARM_FP)
  // In C it would be a call where the compiler has to set errno.
  if constexpr (std::is_same_v<Float, float>) {
    Float root;
    asm("vsqrt.f32 %0, %1" : "=t"(root) : "t"(x));
    return root;
  }
#endif
#if defined(__SSE2__)
  if constexpr (std::is_same_v<Float, float>) {
    return __builtin_sqrtf(x);
  } else {
    return __builtin_sqrt(x);
  }
#else
  return sqrt(x);
#endif
}

}  // namespace sonoglide::numeric
