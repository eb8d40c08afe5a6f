/// Binary fixed-point numbers in two's complement.
///
/// Multiplication, division and conversion round to nearest, ties toward +infinity. An overflow
/// gives the nearest end of the range and is reported to the policy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "firmware/numeric/signal_ledger.hpp"
#include "firmware/numeric/word.hpp"

namespace sonoglide::numeric {

// What fixed-point arithmetic does when a result leaves its range: policies as type tags. Under
// every policy the result is the nearest end of the range. The policies differ in what else an
// overflow does.

/// For the image: clamps, and costs nothing more.
struct Saturating {
  static constexpr void on_overflow() {}
};

/// For simulation: the same values as Saturating, and the attached SignalLedger counts each clamp.
struct Counting {
  static void on_overflow() {
    if (attached_ledger != nullptr) {
      ++attached_ledger->pending_saturations;
    }
  }
};

/// For tests: the program stops where the first overflow happens.
struct Trapping {
  [[noreturn]] static void on_overflow() { __builtin_trap(); }
};

static_assert((-1 >> 1) == -1, "right shift of a negative number must be arithmetic");

/// value / 2^shift, rounded to nearest, ties toward +infinity; value + 2^(shift-1) must not
/// overflow.
template <class Integer>
constexpr Integer shift_right_rounded(Integer value, int shift) {
  if (shift == 0) {
    return value;
  }
  return static_cast<Integer>((value + (Integer{1} << (shift - 1))) >> shift);
}

/// Integer nearest to x, ties toward +infinity; |x| must lie within the range of Integer.
template <class Integer, class Float>
constexpr Integer round_half_up(Float x) {
  const auto truncated = static_cast<Integer>(x);
  const Float rest = x - static_cast<Float>(truncated);
  if (rest >= static_cast<Float>(0.5)) {
    return truncated + 1;
  }
  return rest < static_cast<Float>(-0.5) ? truncated - 1 : truncated;
}

/// A number raw * 2^-FractionBits.
///
/// @tparam Storage       std::int16_t or std::int32_t; results are exact, in a type of twice that
///                       width, before the one rounding.
/// @tparam FractionBits  0 to 15 or 31; with the largest the range is [-1, 1).
/// @tparam Policy        see overflow.hpp.
/// Conversions are explicit only. Division by zero is an overflow: the end of the range on the side
/// of the dividend's sign, and 0 for 0/0.
template <class Storage, int FractionBits, class Policy>
class Fixed {
  static_assert(std::is_same_v<Storage, std::int16_t> || std::is_same_v<Storage, std::int32_t>);
  static_assert(FractionBits >= 0 && FractionBits <= std::numeric_limits<Storage>::digits);

 public:
  using Raw = Storage;
  using Overflow = Policy;
  using Wide =
      std::conditional_t<std::is_same_v<Storage, std::int16_t>, std::int32_t, std::int64_t>;
  static constexpr int fraction_bits = FractionBits;

  constexpr Fixed() = default;

  static constexpr Fixed from_raw(Storage raw) {
    Fixed result;
    result.raw_ = raw;
    return result;
  }

  /// Raw value of a wider type, brought into range by the policy.
  template <class Integer>
  static constexpr Fixed from_wide(Integer raw) {
    static_assert(sizeof(Integer) >= sizeof(Wide));
    const auto narrow = static_cast<Storage>(raw);
    return narrow == raw ? from_raw(narrow) : beyond(raw < 0);
  }

  /// The result of an overflow: an end of the range. Reports it to the policy.
  static constexpr Fixed beyond(bool lower_end) {
    Overflow::on_overflow();
    return lower_end ? lowest() : largest();
  }

  /// The same, of a sum that has wrapped to this. It is computed: for each constant a compiler would make a copy of
  /// what follows.
  static constexpr Fixed beyond_wrapped(std::int32_t sum) {
    Overflow::on_overflow();
    if (!__builtin_is_constant_evaluated()) {
      keep_branch(sum);
    }
    return from_raw(static_cast<Storage>((sum >> 31) ^ lowest().raw_));
  }

  /// For constants and for the host; NaN is an overflow and gives 0.
  static constexpr Fixed from_real(double value) {
    const double scaled = value * unit;
    if (!(scaled >= static_cast<double>(std::numeric_limits<Storage>::min()) - 0.5)) {
      Overflow::on_overflow();
      return scaled < 0.0 ? lowest() : Fixed();
    }
    if (scaled >= static_cast<double>(std::numeric_limits<Storage>::max()) + 0.5) {
      Overflow::on_overflow();
      return largest();
    }
    return from_raw(static_cast<Storage>(round_half_up<std::int64_t>(scaled)));
  }

  static constexpr Fixed largest() { return from_raw(std::numeric_limits<Storage>::max()); }
  static constexpr Fixed lowest() { return from_raw(std::numeric_limits<Storage>::min()); }

  constexpr Storage raw() const { return raw_; }
  /// Exact. For the host.
  constexpr double to_real() const { return static_cast<double>(raw_) / unit; }

  friend constexpr Fixed operator+(Fixed a, Fixed b) {
    Storage sum = 0;
    return __builtin_add_overflow(a.raw_, b.raw_, &sum) ? beyond_wrapped(sum) : from_raw(sum);
  }
  friend constexpr Fixed operator-(Fixed a, Fixed b) {
    Storage difference = 0;
    return __builtin_sub_overflow(a.raw_, b.raw_, &difference) ? beyond_wrapped(difference)
                                                               : from_raw(difference);
  }
  friend constexpr Fixed operator-(Fixed a) { return Fixed() - a; }
  friend constexpr Fixed operator*(Fixed a, Fixed b) {
    if constexpr (is_q31 && !has_wide_product) {
      // Of all products only this one leaves the range.
      return a == b && a == lowest() ? beyond(false)
                                     : from_raw(rounded_q31_product_of_halves(a.raw_, b.raw_));
    } else if constexpr (is_q31) {
      // Of all products only that of -1 and -1 leaves the range, and no other one gives -1.
      const Storage raw = rounded_q31_product(a.raw_, b.raw_);
      Storage below = 0;
      if (__builtin_sub_overflow(raw, 1, &below)) {
        Overflow::on_overflow();
        return from_raw(below);  // the largest
      }
      return from_raw(raw);
    } else {
      return from_wide(rounded_product(a, b));
    }
  }
  friend constexpr Fixed operator/(Fixed a, Fixed b) {
    if constexpr (is_q31) {
      return divided(a, b);
    } else {
      return b.raw_ == 0 ? divided_by_zero(a) : from_wide(rounded_quotient(a, b));
    }
  }

  constexpr Fixed& operator+=(Fixed other) { return *this = *this + other; }
  constexpr Fixed& operator-=(Fixed other) { return *this = *this - other; }
  constexpr Fixed& operator*=(Fixed other) { return *this = *this * other; }
  constexpr Fixed& operator/=(Fixed other) { return *this = *this / other; }

  friend constexpr bool operator==(Fixed a, Fixed b) { return a.raw_ == b.raw_; }
  friend constexpr bool operator!=(Fixed a, Fixed b) { return a.raw_ != b.raw_; }
  friend constexpr bool operator<(Fixed a, Fixed b) { return a.raw_ < b.raw_; }
  friend constexpr bool operator<=(Fixed a, Fixed b) { return a.raw_ <= b.raw_; }
  friend constexpr bool operator>(Fixed a, Fixed b) { return a.raw_ > b.raw_; }
  friend constexpr bool operator>=(Fixed a, Fixed b) { return a.raw_ >= b.raw_; }

  /// a * b as a raw value, rounded but not yet brought into range; in Q31 a and b are not both -1.
  static constexpr Wide rounded_product(Fixed a, Fixed b) {
    if constexpr (is_q31) {
      return rounded_q31_product(a.raw_, b.raw_);
    } else {
      return shift_right_rounded<Wide>(Wide{a.raw_} * Wide{b.raw_}, FractionBits);
    }
  }

 private:
  static constexpr double unit = static_cast<double>(std::int64_t{1} << FractionBits);
  static constexpr bool is_q31 = FractionBits == 31;

  /// Out of line, because a step seldom divides. GCC for RISC-V makes the way past a cold call longer.
#if defined(__riscv)
  [[gnu::noinline]]
#else
  [[gnu::noinline, gnu::cold]]
#endif
  static constexpr Fixed
  divided(Fixed a, Fixed b) {
    return b.raw_ == 0 ? divided_by_zero(a) : from_wide(q31_quotient(a.raw_, b.raw_));
  }

  static constexpr Wide rounded_quotient(Fixed a, Fixed b) {
    const Wide sign = b.raw_ < 0 ? -1 : 1;
    const Wide divisor = sign * b.raw_;
    const Wide dividend = sign * a.raw_ * (Wide{1} << FractionBits);
    const Wide quotient = dividend / divisor;
    const Wide rest = dividend % divisor;
    const Wide up = rest >= divisor - rest ? 1 : 0;
    const Wide down = -rest > divisor + rest ? 1 : 0;
    return quotient + up - down;
  }

  static constexpr Fixed divided_by_zero(Fixed dividend) {
    Overflow::on_overflow();
    if (dividend.raw_ == 0) {
      return Fixed();
    }
    return dividend.raw_ < 0 ? lowest() : largest();
  }

  Storage raw_ = 0;
};

/// Range [-1, 1), steps of 2^-31.
template <class Overflow>
using Q31 = Fixed<std::int32_t, 31, Overflow>;
/// Range [-1, 1), steps of 2^-15.
template <class Overflow>
using Q15 = Fixed<std::int16_t, 15, Overflow>;

/// The same number in another format or under another policy, rounded to nearest, ties toward
/// +infinity; overflow by the policy of the target.
template <class Target, class Storage, int FractionBits, class Overflow>
constexpr Target fixed_cast(Fixed<Storage, FractionBits, Overflow> x) {
  constexpr int shift = Target::fraction_bits - FractionBits;
  std::int64_t raw = x.raw();
  if constexpr (shift >= 0) {
    raw *= std::int64_t{1} << shift;
  } else {
    raw = shift_right_rounded(raw, -shift);
  }
  return Target::from_wide(raw);
}

namespace detail {

template <class Number, std::size_t N, std::size_t... I>
constexpr Number fixed_dot(const std::array<Number, N>& a, const std::array<Number, N>& b,
                           std::index_sequence<I...> /*indices*/) {
  return Number::from_wide((std::int64_t{Number::rounded_product(a[I], b[I])} + ...));
}

}  // namespace detail

/// Sum of a[i] * b[i]. Each product is rounded as by operator*; only the sum is brought into range.
/// In Q31 a[i] and b[i] are not both -1.
template <class Storage, int FractionBits, class Overflow, std::size_t N>
constexpr Fixed<Storage, FractionBits, Overflow> dot(
    const std::array<Fixed<Storage, FractionBits, Overflow>, N>& a,
    const std::array<Fixed<Storage, FractionBits, Overflow>, N>& b) {
  return detail::fixed_dot(a, b, std::make_index_sequence<N>{});
}

}  // namespace sonoglide::numeric
