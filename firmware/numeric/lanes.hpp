/// A few numbers side by side: what every processor's vector unit, or none at all, can hold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/numeric/float_format.hpp"

namespace sonoglide::numeric {

namespace detail {

template <class Float>
struct LaneTypes;

template <>
struct LaneTypes<double> {
  using Numbers = double __attribute__((vector_size(16)));
  using Bits = std::int64_t __attribute__((vector_size(16)));
};

template <>
struct LaneTypes<float> {
  using Numbers = float __attribute__((vector_size(16)));
  using Bits = std::int32_t __attribute__((vector_size(16)));
};

}  // namespace detail

/// 16 bytes of numbers, with + - * / and comparisons lane by lane; the compiler writes them out one
/// by one where there is no vector unit. The same bits as the scalar operations give.
template <class Float>
using Lanes = typename detail::LaneTypes<Float>::Numbers;

/// What a comparison of lanes gives: all bits set where it holds.
template <class Float>
using LaneBits = typename detail::LaneTypes<Float>::Bits;

template <class Float>
inline constexpr std::size_t lane_count = 16 / sizeof(Float);

template <class Float>
[[gnu::always_inline]] inline Lanes<Float> broadcast(Float x) {
  return Lanes<Float>{} + x;
}

/// The lanes that begin at `from`, which need not be aligned.
template <class Float>
[[gnu::always_inline]] inline Lanes<Float> load(const Float* from) {
  Lanes<Float> lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

template <class Float>
[[gnu::always_inline]] inline Float sum_of_lanes(Lanes<Float> x) {
  if constexpr (lane_count<Float> == 2) {
    return x[0] + x[1];
  } else {
    return (x[0] + x[1]) + (x[2] + x[3]);
  }
}

/// exp(-z), z between 0 and the largest exponent of the format, or a little below 0.
/// Relative error <= 1e-14 (1 + z / 4) in double, 3e-7 (1 + z / 4) in float.
///
/// About the nearest power of two, by the series on [-ln(2)/2, ln(2)/2]; each level doubles the
/// powers of its argument.
template <class Float>
[[gnu::always_inline]] inline Lanes<Float> decay(Lanes<Float> z) {
  constexpr bool is_double = sizeof(Float) == sizeof(double);
  constexpr int fraction_bits = FloatFormat<Float>::fraction_bits;
  constexpr Float shifter = static_cast<Float>(1.5) * power_of_two<Float>(fraction_bits);
  const Lanes<Float> shifted = z * static_cast<Float>(-1.44269504088896340736) + shifter;
  const Lanes<Float> power = shifted - shifter;
  const Lanes<Float> r = -z - power * static_cast<Float>(0.693147180559945309417);
  const LaneBits<Float> exponent = reinterpret_cast<LaneBits<Float>>(shifted) << fraction_bits;
  const Lanes<Float> r2 = r * r;
  const Lanes<Float> r4 = r2 * r2;
  const auto term = [](int n) {
    double factorial = 1.0;
    for (int i = 2; i <= n; ++i) {
      factorial *= i;
    }
    return static_cast<Float>(1.0 / factorial);
  };
  Lanes<Float> series = (Float(1) + r) + r2 * (term(2) + term(3) * r) +
                        r4 * ((term(4) + term(5) * r) + r2 * (term(6) + term(7) * r));
  if constexpr (is_double) {
    series += (r4 * r4) * ((term(8) + term(9) * r) + r2 * (term(10) + term(11) * r));
  }
  return reinterpret_cast<Lanes<Float>>(reinterpret_cast<LaneBits<Float>>(series) + exponent);
}

}  // namespace sonoglide::numeric
