/// Modulus and direction of a pair of numbers.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/near_root.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/word.hpp"

namespace sonoglide::numeric {

/// x + jy = modulus (cosine + j sine).
template <class Scalar>
struct Polar {
  Scalar modulus;
  Scalar cosine;
  Scalar sine;
  Floating<Scalar> inverse;  ///< 1/modulus
};

/// Of 0 the direction is 1 and the inverse 0. x and y at most 2^60 in magnitude, and the larger one
/// 0 or at least 2^-60. Error: 4 units of the last place of the modulus and of the inverse, and 4 of
/// the last place of 1 of the direction.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Polar<Float> polar(Float x, Float y) {
  const Float square = x * x + y * y;
  Float inverse(0);
  Float cosine(1);
  if (square > Float(0)) {
    inverse = near_inverse_root(square);
    cosine = x * inverse;
  }
  return {square * inverse, cosine, y * inverse, inverse};
}

/// The same in fixed point. Of 0 the direction is 1 and the inverse 1/2.
///
/// Error: 2^-23 of modulus and inverse and a unit of the last place, 2^-23 of the direction. A
/// modulus of 1 or more gives the largest value; that is not an overflow, and the direction holds.
template <class Overflow>
constexpr Polar<Q31<Overflow>> polar(Q31<Overflow> x, Q31<Overflow> y) {
  using Scalar = Q31<Overflow>;
  const std::uint64_t square = static_cast<std::uint64_t>(std::int64_t{x.raw()} * x.raw()) +
                               static_cast<std::uint64_t>(std::int64_t{y.raw()} * y.raw());
  if (square == 0) {
    return {Scalar{}, Scalar::largest(), Scalar{}, {from_real<Scalar>(0.5), 0}};
  }
  const int shift = __builtin_clzll(square) / 2;
  const auto leading = static_cast<std::uint32_t>((square << (2 * shift)) >> 32);
  const std::uint32_t inverse = near_inverse_root_of_bits(leading);
  const auto limited_inverse = static_cast<std::int32_t>(inverse - (inverse >> 31));
  const Scalar quarter_inverse = Scalar::from_raw(static_cast<std::int32_t>(inverse >> 1));
  const auto along = [&](Scalar part) {
    const std::int32_t raw = part.raw();
    const std::int32_t up = shift > 0 ? raw * (std::int32_t{1} << (shift - 1)) : raw >> 1;
    return lifted(half_product(Scalar::from_raw(up), quarter_inverse), 3);
  };
  const std::uint32_t root = high_word(leading, inverse);  // half of the modulus, lifted by shift
  const Scalar modulus = shift > 0
                             ? Scalar::from_raw(static_cast<std::int32_t>((root << 2) >> shift))
                             : Scalar::largest();
  return {modulus, along(x), along(y), {Scalar::from_raw(limited_inverse), shift}};
}

}  // namespace sonoglide::numeric
