/// Operations that generic code needs of its scalar: double, float or Fixed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/float_unit.hpp"

namespace sonoglide::numeric {

template <class Scalar>
struct IsFixedPoint : std::false_type {};
template <class Storage, int FractionBits, class Overflow>
struct IsFixedPoint<Fixed<Storage, FractionBits, Overflow>> : std::true_type {};

template <class Scalar>
inline constexpr bool is_fixed_point_v = IsFixedPoint<Scalar>::value;

/// Nearest value of the scalar; fixed point rounds ties toward +infinity and overflows by policy.
/// For constants and the host; on a board without a double unit for compile time only.
template <class Scalar>
constexpr Scalar from_real(double value) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return Scalar::from_real(value);
  } else {
    return static_cast<Scalar>(value);
  }
}

/// Exact. For the host.
template <class Scalar>
constexpr double to_real(Scalar x) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return x.to_real();
  } else {
    return static_cast<double>(x);
  }
}

/// |x|; the lowest fixed-point value overflows.
template <class Scalar>
constexpr Scalar abs(Scalar x) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return __builtin_fabs(x);
  } else if constexpr (std::is_same_v<Scalar, float>) {
    return __builtin_fabsf(x);
  } else {
    return x < Scalar{} ? -x : x;
  }
}

/// Sign of a floating-point number: -1, 0 or 1; 0 for both zeros and for NaN.
template <class Scalar>
constexpr Scalar sign(Scalar x) {
  return static_cast<Scalar>(static_cast<int>(x > Scalar(0)) - static_cast<int>(x < Scalar(0)));
}

/// For the order of the code: the condition mostly holds.
constexpr bool likely(bool condition) {
  return __builtin_expect(condition, 1) != 0;
}

/// The smaller of a and b; a if one of them is NaN.
template <class Scalar>
constexpr Scalar min(Scalar a, Scalar b) {
  return b < a ? b : a;
}

/// The larger of a and b; a if one of them is NaN.
template <class Scalar>
constexpr Scalar max(Scalar a, Scalar b) {
  return a < b ? b : a;
}

/// x limited to [low, high], low <= high; NaN stays NaN.
template <class Scalar>
constexpr Scalar clamp(Scalar x, Scalar low, Scalar high) {
  if (x < low) {
    return low;
  }
  return high < x ? high : x;
}

/// 0 <= x < high, high >= 0 and not -0; false for x = -0 and NaN. One comparison of words: those of positive numbers
/// have their order, and those of all other numbers are larger.
template <class Scalar>
constexpr bool is_below(Scalar x, Scalar high) {
  if constexpr (is_fixed_point_v<Scalar>) {
    using Word = std::make_unsigned_t<typename Scalar::Raw>;
    return static_cast<Word>(x.raw()) < static_cast<Word>(high.raw());
  } else {
    return to_bits(x) < to_bits(high);
  }
}

/// level <= x, level > 0; of a NaN nothing is said. One comparison of words too: a negative number has a
/// negative one.
template <class Scalar>
constexpr bool reaches(Scalar x, Scalar level) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return level <= x;
  } else {
    using Word = std::make_signed_t<FloatBits<Scalar>>;
    return static_cast<Word>(to_bits(level)) <= static_cast<Word>(to_bits(x));
  }
}

/// x < 0, or -0: the sign alone.
template <class Scalar>
constexpr bool is_negative(Scalar x) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return x.raw() < 0;
  } else {
    return to_bits(x) >> (8 * sizeof x - 1) != 0;
  }
}

/// x limited to [0, most], most > 0; NaN stays NaN. Quicker than clamp() where x is inside.
template <class Scalar>
constexpr Scalar clamp_positive(Scalar x, Scalar most) {
  return likely(is_below(x, most)) ? x : clamp(x, Scalar{}, most);
}

/// x limited to [-most, most], most >= 0; NaN stays NaN. Quicker than clamp() where x is inside.
template <class Scalar>
constexpr Scalar clamp_magnitude(Scalar x, Scalar most) {
  if (likely(!(most < abs(x)))) {
    return x;
  }
  return x < Scalar{} ? -most : most;
}

/// False for NaN and the infinities; a fixed-point number is always finite.
template <class Scalar>
constexpr bool is_finite(Scalar x) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return true;
  } else {
    return to_bits(abs(x)) < to_bits(std::numeric_limits<Scalar>::infinity());
  }
}

/// 2 x; overflow by policy or by IEEE-754.
template <class Scalar>
constexpr Scalar twice(Scalar x) {
  return x + x;
}

/// x / 2; fixed point rounds ties toward +infinity.
template <class Scalar>
constexpr Scalar half(Scalar x) {
  if constexpr (is_fixed_point_v<Scalar>) {
    using Raw = typename Scalar::Raw;
    const Raw raw = x.raw();
    return Scalar::from_raw(static_cast<Raw>((raw >> 1) + (raw & 1)));
  } else {
    return x * static_cast<Scalar>(0.5);
  }
}

/// x * 2^n, rounded once; overflow by policy or by IEEE-754.
template <class Scalar>
constexpr Scalar scale_by_power_of_two(Scalar x, int n) {
  if constexpr (is_fixed_point_v<Scalar>) {
    using Raw = typename Scalar::Raw;
    constexpr int digits = std::numeric_limits<Raw>::digits;
    const Raw raw = x.raw();
    if (n < 0) {
      // A half of the last digit is the digit that is shifted out last.
      return n < -digits ? Scalar{}
                         : Scalar::from_raw(static_cast<Raw>((raw >> -n) + (raw >> (-n - 1) & 1)));
    }
    if (n <= digits) {
      const auto shifted = static_cast<Raw>(static_cast<std::uint32_t>(raw) << n);
      if (shifted >> n == raw) {
        return Scalar::from_raw(shifted);
      }
    }
    return raw == 0 ? Scalar{} : Scalar::beyond(raw < 0);
  } else {
    constexpr int highest = std::numeric_limits<Scalar>::max_exponent - 1;
    constexpr int lowest = std::numeric_limits<Scalar>::min_exponent - 1;
    // A step down stops short of the subnormals, so that only the last one can round.
    constexpr int down = lowest + std::numeric_limits<Scalar>::digits;
    for (int step = 0; step < 2 && n > highest; ++step, n -= highest) {
      x *= power_of_two<Scalar>(highest);
    }
    for (int step = 0; step < 2 && n < lowest; ++step, n -= down) {
      x *= power_of_two<Scalar>(down);
    }
    return x * power_of_two<Scalar>(clamp(n, lowest, highest));
  }
}

/// x = mantissa * 2^exponent.
template <class Scalar>
struct Split {
  Scalar mantissa;
  int exponent;
};

/// Splits x, finite and above 0, into a mantissa in [0.5, 1) and a power of two.
///
/// Exact, subnormals included; only a fixed-point value above 1 that has more digits than the
/// mantissa's fraction holds is rounded. A fixed-point format needs at least one fraction bit.
template <class Scalar>
constexpr Split<Scalar> split_positive(Scalar x) {
  if constexpr (is_fixed_point_v<Scalar>) {
    static_assert(Scalar::fraction_bits > 0);
    const int exponent = bit_width(static_cast<std::uint32_t>(x.raw())) - Scalar::fraction_bits;
    if constexpr (Scalar::fraction_bits == std::numeric_limits<typename Scalar::Raw>::digits) {
      return {Scalar::from_raw(static_cast<typename Scalar::Raw>(x.raw() << -exponent)), exponent};
    }
    const Scalar mantissa = scale_by_power_of_two(x, -exponent);
    constexpr std::int64_t one = std::int64_t{1} << Scalar::fraction_bits;
    if (mantissa.raw() == one) {
      return {half(mantissa), exponent + 1};
    }
    return {mantissa, exponent};
  } else {
    using Format = FloatFormat<Scalar>;
    const bool subnormal = x < std::numeric_limits<Scalar>::min();
    const int lift = subnormal ? std::numeric_limits<Scalar>::digits : 0;
    const Scalar normal = x * power_of_two<Scalar>(lift);
    const FloatBits<Scalar> bits = to_bits(normal);
    const int exponent =
        static_cast<int>(bits >> Format::fraction_bits) - Format::exponent_bias + 1;
    const auto shift = static_cast<FloatBits<Scalar>>(exponent) << Format::fraction_bits;
    return {from_bits<Scalar>(bits - shift), exponent - lift};
  }
}

/// As split_positive(). 0, negative numbers, infinity and NaN are returned unchanged, with exponent 0.
template <class Scalar>
constexpr Split<Scalar> split(Scalar x) {
  return x > Scalar{} && is_finite(x) ? split_positive(x) : Split<Scalar>{x, 0};
}

/// A left-justified converter code as a number: code * 2^-31, rounded to the scalar. In fixed point
/// a code that rounds to +1 gives the largest value; that is not an overflow.
template <class Scalar>
constexpr Scalar from_code(std::int32_t code) {
  if constexpr (is_fixed_point_v<Scalar>) {
    constexpr int surplus = 31 - Scalar::fraction_bits;
    if constexpr (surplus == 0) {
      return Scalar::from_raw(code);
    } else {
      const std::int32_t raw = ((code >> (surplus - 1)) + 1) >> 1;
      constexpr std::int32_t largest = Scalar::largest().raw();
      return Scalar::from_raw(static_cast<typename Scalar::Raw>(raw < largest ? raw : largest));
    }
  } else {
    if constexpr (converts_codes<Scalar>) {
      if (!__builtin_is_constant_evaluated() && !__builtin_constant_p(code)) {
        return code_to_float<Scalar>(code);
      }
    }
    return static_cast<Scalar>(code) * power_of_two<Scalar>(-31);
  }
}

namespace detail {

/// The bits of the least number x > 0 such that x 2^31, and that of each larger one, has no digits after the point.
/// Floating-point numbers above 0 have the order of their bits, and integers are compared faster.
template <class Float>
constexpr FloatBits<Float> least_whole_code() {
  return to_bits(power_of_two<Float>(std::numeric_limits<Float>::digits - 32));
}

/// Whether x 2^31 has no digits after the point because x is so large, and is in range.
template <class Float>
constexpr bool has_whole_code(Float x) {
  if constexpr (std::numeric_limits<Float>::digits > 31) {
    return false;
  } else {
    constexpr FloatBits<Float> room = to_bits(Float(1)) - least_whole_code<Float>();
    return to_bits(abs(x)) - least_whole_code<Float>() < room;
  }
}

}  // namespace detail

/// The converter code nearest to x * 2^31, ties toward +infinity, limited to [-2^31, 2^31 - 1].
/// NaN gives 0. In fixed point the limiting is an overflow of the scalar's policy.
template <class Scalar>
constexpr std::int32_t to_code(Scalar x) {
  if constexpr (is_fixed_point_v<Scalar>) {
    return fixed_cast<Q31<typename Scalar::Overflow>>(x).raw();
  } else {
    using Code = std::numeric_limits<std::int32_t>;
    if constexpr (converts_codes<Scalar>) {
      if (!__builtin_is_constant_evaluated() &&
          likely(to_bits(abs(x)) >= detail::least_whole_code<Scalar>())) {
        return float_to_code(x);
      }
    }
    const Scalar scaled = x * power_of_two<Scalar>(31);
    if (likely(detail::has_whole_code(x))) {
      return static_cast<std::int32_t>(scaled);
    }
    if (scaled >= static_cast<Scalar>(2147483647.5)) {
      return Code::max();
    }
    if (scaled > static_cast<Scalar>(-2147483648.0)) {
      return round_half_up<std::int32_t>(scaled);
    }
    return scaled < Scalar{0} ? Code::min() : 0;
  }
}

namespace detail {

template <class Float, std::size_t N, std::size_t... I>
constexpr Float float_dot(const std::array<Float, N>& a, const std::array<Float, N>& b,
                          std::index_sequence<I...> /*indices*/) {
  return (... + (a[I] * b[I]));
}

}  // namespace detail

/// Sum of a[i] * b[i], from left to right.
template <class Float, std::size_t N, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
constexpr Float dot(const std::array<Float, N>& a, const std::array<Float, N>& b) {
  return detail::float_dot(a, b, std::make_index_sequence<N>{});
}

}  // namespace sonoglide::numeric
