/// The quick root that step-size control needs.
#pragma once

#include <type_traits>

#include "firmware/numeric/float_format.hpp"

namespace sonoglide::numeric {

/// x^(1/Degree) within 7 %, x > 0 and normal; something large for infinity.
///
/// The bits of a floating-point number, read as an integer, are nearly its logarithm: those of the
/// root lie as much closer to those of 1. The same bits on every machine, and no logarithm.
template <int Degree, class Float>
constexpr Float quick_root(Float x) {
  using Bits = numeric::FloatBits<Float>;
  constexpr Bits one = numeric::to_bits(Float(1));
  constexpr Bits kept = one - one / Degree;
  return numeric::from_bits<Float>(static_cast<Bits>(kept + numeric::to_bits(x) / Degree));
}

/// (a / b)^(1/Degree) within 8 %, Degree >= 4, a and b normal; larger for b = 0.
///
/// The difference of the bits is nearly the logarithm of the quotient, which may itself be beyond
/// the format.
template <int Degree, class Float>
constexpr Float quick_root_of_quotient(Float a, Float b) {
  using Bits = numeric::FloatBits<Float>;
  using Difference = std::make_signed_t<Bits>;
  constexpr Bits one = numeric::to_bits(Float(1));
  const auto difference = static_cast<Difference>(numeric::to_bits(a) - numeric::to_bits(b));
  return numeric::from_bits<Float>(one + static_cast<Bits>(difference / Degree));
}

}  // namespace sonoglide::numeric
