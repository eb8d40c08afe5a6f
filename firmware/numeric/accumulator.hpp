/// The wider type in which products and sums of a scalar are kept before they are rounded.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/headroom.hpp"

namespace sonoglide::numeric {

/// The type in which products wait to be scaled and many small terms are summed: Q31 for Q15, as in
/// a multiply-accumulate unit, and the scalar itself otherwise.
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

/// a·b in the accumulator, a and b not both -1 (undefined). For Q15 exact; otherwise rounded as by operator*.
template <class Scalar>
constexpr Accumulator<Scalar> accumulated_product(Scalar a, Scalar b) {
  using Sum = Accumulator<Scalar>;
  if constexpr (std::is_same_v<Sum, Scalar>) {
    return bounded_product(a, b);
  } else {
    return Sum::from_raw(2 * a.raw() * b.raw());
  }
}

/// A scalar from its accumulator, rounded once, ties toward +infinity; overflow by policy.
template <class Scalar>
constexpr Scalar rounded(Accumulator<Scalar> sum) {
  if constexpr (std::is_same_v<Accumulator<Scalar>, Scalar>) {
    return sum;
  } else {
    return Scalar::from_wide(((sum.raw() >> 15) + 1) >> 1);
  }
}

}  // namespace sonoglide::numeric
