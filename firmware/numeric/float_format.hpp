/// Binary layout of the IEEE-754 formats, and the operations that need nothing but that layout.
#pragma once

#include <cfloat>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace sonoglide::numeric {

// Same bits on every machine needs every operation rounded to its own type; 16 differs from 0 in
// half precision only.
static_assert(FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 16,
              "floating point must be evaluated without excess precision");
static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<double>::is_iec559,
              "IEEE-754 binary32 and binary64 are required");

template <class Float>
struct FloatFormat;

template <>
struct FloatFormat<float> {
  using Bits = std::uint32_t;
  static constexpr int fraction_bits = 23;
  static constexpr int exponent_bias = 127;
};

template <>
struct FloatFormat<double> {
  using Bits = std::uint64_t;
  static constexpr int fraction_bits = 52;
  static constexpr int exponent_bias = 1023;
};

template <class Float>
using FloatBits = typename FloatFormat<Float>::Bits;

template <class Float>
constexpr FloatBits<Float> to_bits(Float x) {
  return __builtin_bit_cast(FloatBits<Float>, x);
}

template <class Float>
constexpr Float from_bits(FloatBits<Float> bits) {
  return __builtin_bit_cast(Float, bits);
}

/// 2^n, n within the normal range of the format.
template <class Float>
constexpr Float power_of_two(int n) {
  using Format = FloatFormat<Float>;
  using Bits = FloatBits<Float>;
  const Bits biased = static_cast<Bits>(n) + static_cast<Bits>(Format::exponent_bias);
  return from_bits<Float>(biased << Format::fraction_bits);
}

/// An integer as a floating-point value and as an int.
template <class Float>
struct NearestInteger {
  Float value;
  std::int32_t integer;
};

/// Integer nearest to x, ties to even, for |x| <= 2^22 (float) or 2^31 (double).
///
/// Adding 1.5 * 2^fraction_bits leaves the sum no bits below the unit; its low bits are the
/// integer.
template <class Float>
constexpr NearestInteger<Float> nearest_integer(Float x) {
  constexpr Float shifter =
      static_cast<Float>(1.5) * power_of_two<Float>(FloatFormat<Float>::fraction_bits);
  const Float sum = x + shifter;
  const auto offset = static_cast<std::uint32_t>(to_bits(sum) - to_bits(shifter));
  return {sum - shifter, static_cast<std::int32_t>(offset)};
}

}  // namespace sonoglide::numeric
