/// Products and sums for quantities that need headroom: few instructions in fixed point.
#pragma once

#include <cstdint>
#include <limits>
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

/// What is kept of a quantity that needs headroom: half of it in fixed point; floating point needs
/// none.
template <class Scalar>
constexpr Scalar kept(double value) {
  return from_real<Scalar>(is_fixed_point_v<Scalar> ? value / 2.0 : value);
}
template <class Scalar>
constexpr Scalar kept_of(Scalar x) {
  return is_fixed_point_v<Scalar> ? half(x) : x;
}
/// a + b, kept: as half_sum().
template <class Scalar>
constexpr Scalar kept_sum(Scalar a, Scalar b) {
  return is_fixed_point_v<Scalar> ? half_sum(a, b) : a + b;
}
/// a - b, kept: as half_difference().
template <class Scalar>
constexpr Scalar kept_difference(Scalar a, Scalar b) {
  return is_fixed_point_v<Scalar> ? half_difference(a, b) : a - b;
}
/// a b, kept: as half_product().
template <class Scalar>
constexpr Scalar kept_product(Scalar a, Scalar b) {
  return is_fixed_point_v<Scalar> ? half_product(a, b) : a * b;
}

/// As a * b, a and b not both -1: without a look at whether the product is in range.
template <class Scalar>
constexpr Scalar bounded_product(Scalar a, Scalar b) {
  if constexpr (is_fixed_point_v<Scalar>) {
    static_assert(Scalar::fraction_bits == std::numeric_limits<typename Scalar::Raw>::digits);
    return Scalar::from_raw(static_cast<typename Scalar::Raw>(Scalar::rounded_product(a, b)));
  } else {
    return a * b;
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

/// x 2^n, 0 <= n < 32; overflow by policy.
template <class Storage, int Bits, class Policy>
constexpr Fixed<Storage, Bits, Policy> raised(Fixed<Storage, Bits, Policy> x, int n) {
  const Storage raw = x.raw();
  const auto shifted = static_cast<Storage>(static_cast<std::uint32_t>(raw) << n);
  return shifted >> n == raw ? Fixed<Storage, Bits, Policy>::from_raw(shifted)
                             : Fixed<Storage, Bits, Policy>::beyond(raw < 0);
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

/// a b - c d 2^n, kept. In fixed point c d 2^n is limited to [-1, 1), which is not an overflow; within
/// 2^(n + 1) units of the last place.
template <class Scalar>
constexpr Scalar difference_with_lifted(Scalar a, Scalar b, Scalar c, Scalar d, int n) {
  if constexpr (is_fixed_point_v<Scalar>) {
    using Raw = typename Scalar::Raw;
    // A limit that is a power of two is an instruction.
    const auto limit = static_cast<Raw>((Scalar::largest().raw() >> (n + 1)) + 1);
    const Raw limited =
        clamp<Raw>(half_product(c, d).raw(), static_cast<Raw>(-limit), static_cast<Raw>(limit - 1));
    return Scalar::from_raw(static_cast<Raw>(half_product(a, b).raw() - limited * (Raw{1} << n)));
  } else {
    return a * b - c * d;
  }
}

/// a² + b², kept, which cannot overflow; a and b not both -1. In fixed point too small by less than two
/// units of the last place.
template <class Scalar>
constexpr Scalar kept_square_sum(Scalar a, Scalar b) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return Scalar::from_raw(
        static_cast<typename Scalar::Raw>(half_product(a, a).raw() + half_product(b, b).raw()));
  } else {
    return a * a + b * b;
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
