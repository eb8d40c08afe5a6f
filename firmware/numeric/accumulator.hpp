/// Where a scalar's products and sums are kept before they are rounded to it.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/numeric/fixed.hpp"

namespace sonoglide::numeric {

/// Where products wait to be scaled and many small terms are summed: the scalar itself, but 32 bits
/// of the same range for a 16-bit number, as in a multiply-accumulate unit.
template <class Scalar>
struct AccumulatorOf {
  using Type = Scalar;
};
template <class Overflow>
struct AccumulatorOf<Q15<Overflow>> {
  using Type = Q31<Overflow>;
};
template <class Scalar>
using Accumulator = typename AccumulatorOf<Scalar>::Type;

/// x in the accumulator; exact.
template <class Scalar>
constexpr Accumulator<Scalar> accumulate(Scalar x) {
  if constexpr (std::is_same_v<Accumulator<Scalar>, Scalar>) {
    return x;
  } else {
    return fixed_cast<Accumulator<Scalar>>(x);
  }
}

/// a·b in the accumulator; exact for a 16-bit number.
template <class Scalar>
constexpr Accumulator<Scalar> accumulated_product(Scalar a, Scalar b) {
  using Sum = Accumulator<Scalar>;
  if constexpr (std::is_same_v<Sum, Scalar>) {
    return a * b;
  } else {
    const std::int32_t product = std::int32_t{a.raw()} * b.raw();
    return product == 1 << 30 ? Sum::beyond(false) : Sum::from_raw(2 * product);
  }
}

/// A scalar from its accumulator, rounded once.
template <class Scalar>
constexpr Scalar rounded(Accumulator<Scalar> sum) {
  if constexpr (std::is_same_v<Accumulator<Scalar>, Scalar>) {
    return sum;
  } else {
    return Scalar::from_wide(((sum.raw() >> 15) + 1) >> 1);
  }
}

}  // namespace sonoglide::numeric
