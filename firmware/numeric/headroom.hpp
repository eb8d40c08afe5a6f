/// Products and sums for quantities that need headroom: few instructions in fixed point.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/word.hpp"

namespace sonoglide::numeric {

/// (a + b)/2, which cannot overflow. In fixed point too small by at most a unit of the last place.
template <class Scalar>
constexpr Scalar half_sum(Scalar a, Scalar b) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return Scalar::from_raw(static_cast<typename Scalar::Raw>((a.raw() >> 1) + (b.raw() >> 1)));
  } else {
    return half(a + b);
  }
}

/// (a - b)/2, which cannot overflow. In fixed point within half a unit of the last place.
template <class Scalar>
constexpr Scalar half_difference(Scalar a, Scalar b) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return Scalar::from_raw(static_cast<typename Scalar::Raw>((a.raw() >> 1) - (b.raw() >> 1)));
  } else {
    return half(a - b);
  }
}

/// a b/2, which cannot overflow. In fixed point rounded down to a unit of the last place.
template <class Scalar>
constexpr Scalar half_product(Scalar a, Scalar b) {
  if constexpr (!is_fixed_point_v<Scalar>) {
    return half(a * b);
  } else if constexpr (Scalar::fraction_bits == 31) {
    return Scalar::from_raw(high_word(a.raw(), b.raw()));
  } else {
    return Scalar::from_raw(static_cast<typename Scalar::Raw>(
        (typename Scalar::Wide{a.raw()} * b.raw()) >> (Scalar::fraction_bits + 1)));
  }
}

/// a b, a and b not both -1. In fixed point too small by less than two units of the last place.
template <class Scalar>
constexpr Scalar rough_product(Scalar a, Scalar b) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return Scalar::from_raw(static_cast<typename Scalar::Raw>(half_product(a, b).raw() * 2));
  } else {
    return a * b;
  }
}

/// a and b are both above 0 or both below it.
template <class Scalar>
constexpr bool same_sign(Scalar a, Scalar b) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return a.raw() != 0 && b.raw() != 0 && (a.raw() ^ b.raw()) >= 0;
  } else {
    return Scalar{} < a * b;
  }
}

/// One of a and b is above 0 and the other one below it.
template <class Scalar>
constexpr bool opposite_signs(Scalar a, Scalar b) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return a.raw() != 0 && b.raw() != 0 && (a.raw() ^ b.raw()) < 0;
  } else {
    return a * b < Scalar{};
  }
}

/// x 2^n, 0 <= n < 32: in floating point x itself, whose numbers are on base 1; in fixed point
/// limited to [-1, 1), which is not an overflow.
template <class Scalar>
constexpr Scalar lifted(Scalar x, int n) {
  if constexpr (is_fixed_point_v<Scalar>) {
    using Raw = typename Scalar::Raw;
    const Raw raw = x.raw();
    const auto shifted = static_cast<Raw>(static_cast<std::uint32_t>(raw) << n);
    if (shifted >> n == raw) {
      return Scalar::from_raw(shifted);
    }
    constexpr Raw whole = Scalar::largest().raw();
    return Scalar::from_raw(raw < 0 ? static_cast<Raw>(-whole) : whole);
  } else {
    return x;
  }
}

/// x 2^n limited to [-1, 1], in fixed point to [-1, 1), which is not an overflow; 0 <= n < 32.
template <class Scalar>
constexpr Scalar limited_lift(Scalar x, int n) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return lifted(x, n);
  } else {
    return clamp_magnitude(scale_by_power_of_two(x, n), Scalar{1});
  }
}

/// (a b + c d) 2^n as lifted(). In fixed point the sum is too small by less than four units of the
/// last place.
template <class Scalar>
constexpr Scalar lifted_sum(Scalar a, Scalar b, Scalar c, Scalar d, int n) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return lifted(half_product(a, b) + half_product(c, d), n + 1);
  } else {
    return a * b + c * d;
  }
}

/// a b + c d; overflow by policy. In fixed point too small by less than four units of the last
/// place.
template <class Scalar>
constexpr Scalar sum_of_products(Scalar a, Scalar b, Scalar c, Scalar d) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return twice(half_product(a, b) + half_product(c, d));
  } else {
    return a * b + c * d;
  }
}

/// a b - c d; overflow by policy. In fixed point within two units of the last place.
template <class Scalar>
constexpr Scalar difference_of_products(Scalar a, Scalar b, Scalar c, Scalar d) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return twice(half_product(a, b) - half_product(c, d));
  } else {
    return a * b - c * d;
  }
}

}  // namespace sonoglide::numeric
