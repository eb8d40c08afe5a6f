/// The quick root that step-size control needs.
#pragma once

#include <type_traits>

#include "firmware/numeric/float_format.hpp"

namespace sonoglide::numeric {

/// x^(1/Degree) within 7 %, x > 0 and normal; for infinity a large number.
///
/// The bits of a floating-point number, read as an integer, are nearly its logarithm. So a
/// Degree-th of their distance from the bits of 1 gives the root, without a logarithm and with the
/// same bits on every machine.
template <int Degree, class Float>
constexpr Float quick_root(Float x) {
  using Bits = numeric::FloatBits<Float>;
  constexpr Bits one = numeric::to_bits(Float(1));
  constexpr Bits kept = one - one / Degree;
  return numeric::from_bits<Float>(static_cast<Bits>(kept + numeric::to_bits(x) / Degree));
}

/// (a / b)^(1/Degree) within 8 %, Degree >= 4, a and b normal; for b = 0 a larger number.
///
/// The difference of the bits is nearly the logarithm of the quotient. The quotient itself may be
/// beyond the format.
template <int Degree, class Float>
constexpr Float quick_root_of_quotient(Float a, Float b) {
  using Bits = numeric::FloatBits<Float>;
  using Difference = std::make_signed_t<Bits>;
  constexpr Bits one = numeric::to_bits(Float(1));
  const auto difference = static_cast<Difference>(numeric::to_bits(a) - numeric::to_bits(b));
  return numeric::from_bits<Float>(one + static_cast<Bits>(difference / Degree));
}

}  // namespace sonoglide::numeric
