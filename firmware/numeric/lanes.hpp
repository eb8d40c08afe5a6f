/// A few numbers side by side, on any processor, with a vector unit or without.
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
  using Bits = std::uint64_t __attribute__((vector_size(16)));
};

template <>
struct LaneTypes<float> {
  using Numbers = float __attribute__((vector_size(16)));
  using Bits = std::uint32_t __attribute__((vector_size(16)));
};

}  // namespace detail

/// 16 bytes of numbers, with + - * / lane by lane; the compiler writes them out one
/// by one where there is no vector unit. The same bits as the scalar operations give.
template <class Float>
using Lanes = typename detail::LaneTypes<Float>::Numbers;

/// The bits of lanes, as unsigned integers.
template <class Float>
using LaneBits = typename detail::LaneTypes<Float>::Bits;

template <class Float>
inline constexpr std::size_t lane_count = 16 / sizeof(Float);

/// x in every lane; -0 becomes 0.
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

/// The sum of the lanes, in pairs.
template <class Float>
[[gnu::always_inline]] inline Float sum_of_lanes(Lanes<Float> x) {
  if constexpr (lane_count<Float> == 2) {
    return x[0] + x[1];
  } else {
    return (x[0] + x[1]) + (x[2] + x[3]);
  }
}

/// The smaller of x and the limit, lane by lane; the limit where x is NaN.
template <class Float>
[[gnu::always_inline]] inline Lanes<Float> at_most(Float limit, Lanes<Float> x) {
  const Lanes<Float> limits = broadcast(limit);
  return x < limits ? x : limits;
}

/// 1 in the lanes that are negative, by their sign bit.
template <class Float>
[[gnu::always_inline]] inline LaneBits<Float> is_negative(Lanes<Float> x) {
  return reinterpret_cast<LaneBits<Float>>(x) >> (8 * sizeof(Float) - 1);
}

/// Largest argument of moderate_decay: beyond it exp(-z) is below the error.
template <class Float>
inline constexpr Float longest_decay = sizeof(Float) == sizeof(double) ? Float(64) : Float(20);

/// exp(-z), of lanes or of a group of them. Error for z in [-0.5, 6]: <= 1e-13 in double, 5e-6 in
/// float; for z up to longest_decay: <= 1e-9 in double, 5e-6 in float.
///
/// A short series gives exp at a fraction of z. Squaring it repeatedly gives exp(-z).
template <class Float, class Numbers>
[[gnu::always_inline]] inline Numbers moderate_decay(Numbers z) {
  constexpr int halvings = sizeof(Float) == sizeof(double) ? 6 : 3;
  const auto term = [](int n) {
    double coefficient = 1.0;
    for (int i = 1; i <= n; ++i) {
      coefficient /= -i;
    }
    return static_cast<Float>(coefficient);
  };
  const Numbers x = z * power_of_two<Float>(-halvings);
  const Numbers square = x * x;
  Numbers power = ((Float(1) - x) + square * (term(2) + term(3) * x)) +
                  (square * square) * ((term(4) + term(5) * x) + square * (term(6) + term(7) * x));
  for (int i = 0; i < halvings; ++i) {
    power *= power;
  }
  return power;
}

}  // namespace sonoglide::numeric
