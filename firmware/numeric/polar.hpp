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
  Multiple<Scalar> inverse;  ///< 1/modulus
};

/// Of 0 the direction is 1 and the inverse 0. x and y at most 2^60 in magnitude, and the larger one
/// 0 or at least 2^-60. Error: 2 units of the last place of the modulus, 3 of the inverse, and 4 of
/// the last place of 1 of the direction.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
Polar<Float> polar(Float x, Float y) {
  const Float square = x * x + y * y;
  if (!(square > Float(0))) {
    return {Float(0), Float(1), Float(0), Float(0)};
  }
  const Float modulus = quick_sqrt(square);
  const Float inverse = Float(1) / modulus;
  return {modulus, x * inverse, y * inverse, inverse};
}

/// The same in fixed point. Where neither x nor y is above 1 or below -2 units of the last place, x is
/// taken for 2 units.
///
/// Error: 2^-23 of modulus and inverse and a unit of the last place, 2^-23 of the direction. A
/// modulus of 1 or more gives the largest value; that is not an overflow, and the direction holds.
template <class Overflow>
constexpr Polar<Q31<Overflow>> polar(Q31<Overflow> x, Q31<Overflow> y) {
  using Scalar = Q31<Overflow>;
  const auto size =
      static_cast<std::uint32_t>((x.raw() ^ (x.raw() >> 31)) | (y.raw() ^ (y.raw() >> 31)));
  const std::int32_t seen = size < 2 ? 2 : x.raw();
  // The larger one is then at least 1/2.
  const int shift = 31 - bit_width(size | 2);
  const auto along = static_cast<std::int32_t>(static_cast<std::uint32_t>(seen) << shift);
  const auto across = static_cast<std::int32_t>(static_cast<std::uint32_t>(y.raw()) << shift);
  const auto square =
      static_cast<std::uint32_t>((static_cast<std::uint64_t>(std::int64_t{along} * along) +
                                  static_cast<std::uint64_t>(std::int64_t{across} * across)) >>
                                 32);  // 30 fraction bits
  const bool above_one = square >= 1U << 30;
  const std::uint32_t leading = above_one ? square : square << 2;
  const std::uint32_t inverse = near_inverse_root_of_bits(leading);
  // Below the true one, so that no direction reaches 1.
  const Scalar lesser = Scalar::from_raw(static_cast<std::int32_t>(inverse - 32));
  const int up = above_one ? 1 : 2;
  const auto part = [&](std::int32_t raw) {
    return Scalar::from_raw(half_product(Scalar::from_raw(raw), lesser).raw() * (1 << up));
  };
  const int down = shift + up - 2;  // -1 where the modulus is above 1
  const std::uint32_t root = high_word(leading, inverse) << 1;
  const Scalar modulus =
      down < 0 ? Scalar::largest() : Scalar::from_raw(static_cast<std::int32_t>(root >> down));
  return {modulus, part(along), part(across), {lesser, down + 1}};
}

}  // namespace sonoglide::numeric
