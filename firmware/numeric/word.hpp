/// Products, quotients and widths of words of 32 bits, by the instructions that the processor has.
#pragma once

#include <cstdint>

namespace sonoglide::numeric {

/// Whether a product of 64 bits is an instruction.
#if defined(__thumb__) && !defined(__thumb2__)
inline constexpr bool has_wide_product = false;
#else
inline constexpr bool has_wide_product = true;
#endif

/// Keeps the branch that it stands in. Without it a compiler for Thumb-2 makes conditional instructions of a short
/// branch, which take their time where the condition is false too.
inline void keep_branch([[maybe_unused]] std::int32_t& result) {
#if defined(__thumb2__)
  asm inline("" : "+r"(result));
#endif
}

/// Whether the number of leading zeros is an instruction.
#if (defined(__thumb__) && !defined(__thumb2__)) || (defined(__riscv) && !defined(__riscv_zbb))
inline constexpr bool has_leading_zeros = false;
#else
inline constexpr bool has_leading_zeros = true;
#endif

/// Whether a division is an instruction.
#if (defined(__thumb__) && !defined(__thumb2__)) || (defined(__riscv) && !defined(__riscv_div))
inline constexpr bool has_division = false;
#else
inline constexpr bool has_division = true;
#endif

/// 2^31 / d, rounded down, 2^15 < d <= 2^16: from Newton's iteration.
constexpr std::uint32_t reciprocal_by_newton(std::uint32_t d) {
  // 48/17 - 32/17 m is within 1/17 of 1/m; two steps square that twice.
  std::uint32_t inverse = 92521 - ((d * 61681) >> 16);  // 15 fraction bits
  for (int i = 0; i < 2; ++i) {
    const auto rest = static_cast<std::int32_t>((1U << 31) - d * inverse);
    inverse +=
        static_cast<std::uint32_t>((static_cast<std::int32_t>(inverse) * (rest >> 16)) >> 15);
  }
  // Never above 2^31 / d: a test tries every d.
  while ((1U << 31) - d * inverse >= d) {
    ++inverse;
  }
  return inverse;
}

/// As reciprocal_by_newton(), by an instruction where the processor has one.
constexpr std::uint32_t reciprocal(std::uint32_t d) {
  return has_division ? (1U << 31) / d : reciprocal_by_newton(d);
}

/// a b = 2^32 whole + 2^16 rest + a number of 0 to 2^16 - 1.
struct ProductOfHalves {
  std::int32_t whole;  ///< -2^30 to 2^30
  std::int32_t rest;   ///< less than 2^31 in magnitude
};

/// From four products of halves; every sum fits a word.
constexpr ProductOfHalves product_of_halves(std::int32_t a, std::int32_t b) {
  const std::int32_t a_low = a & 0xffff;
  const std::int32_t b_low = b & 0xffff;
  const std::int32_t a_high = a >> 16;
  const std::int32_t b_high = b >> 16;
  const std::uint32_t low = static_cast<std::uint32_t>(a_low) * static_cast<std::uint32_t>(b_low);
  const std::int32_t middle = a_high * b_low + static_cast<std::int32_t>(low >> 16);
  const std::int32_t rest = a_low * b_high + (middle & 0xffff);
  return {a_high * b_high + (middle >> 16), rest};
}

#if defined(__thumb__) && !defined(__thumb2__)
/// The same in 15 instructions; GCC 12 takes three more, two for each low half.
inline ProductOfHalves product_of_halves_in_thumb(std::int32_t a, std::int32_t b) {
  std::int32_t middle = 0;
  std::int32_t rest = 0;
  std::int32_t low = 0;
  asm(".syntax unified\n\t"
      "uxth %[rest], %[a]\n\t"
      "uxth %[middle], %[b]\n\t"
      "asrs %[a], %[a], #16\n\t"
      "asrs %[b], %[b], #16\n\t"
      "movs %[low], %[rest]\n\t"
      "muls %[low], %[middle], %[low]\n\t"
      "lsrs %[low], %[low], #16\n\t"
      "muls %[middle], %[a], %[middle]\n\t"
      "adds %[middle], %[middle], %[low]\n\t"
      "muls %[rest], %[b], %[rest]\n\t"
      "muls %[a], %[b], %[a]\n\t"
      "asrs %[low], %[middle], #16\n\t"
      "adds %[a], %[a], %[low]\n\t"
      "uxth %[middle], %[middle]\n\t"
      "adds %[rest], %[rest], %[middle]"
      : [a] "+l"(a), [b] "+l"(b), [middle] "=&l"(middle), [rest] "=&l"(rest), [low] "=&l"(low)
      :
      : "cc");
  return {a, rest};
}
#endif

/// As product_of_halves(), without a wide product.
constexpr ProductOfHalves narrow_product(std::int32_t a, std::int32_t b) {
#if defined(__thumb__) && !defined(__thumb2__)
  if (!__builtin_is_constant_evaluated()) {
    return product_of_halves_in_thumb(a, b);
  }
#endif
  return product_of_halves(a, b);
}

/// (a b + 2^30) / 2^31, rounded down: the product of two numbers with 31 fraction bits, to nearest,
/// ties toward +infinity. a and b are not both -2^31.
constexpr std::int32_t rounded_q31_product_of_halves(std::int32_t a, std::int32_t b) {
  const auto [whole, rest] = narrow_product(a, b);
  // The first part alone may be 2^31: unsigned, it wraps and comes back.
  return static_cast<std::int32_t>(2 * static_cast<std::uint32_t>(whole) +
                                   static_cast<std::uint32_t>(((rest >> 14) + 1) >> 1));
}

#if defined(__thumb2__)
/// As rounded_q31_product(), in three instructions; GCC 12 takes five.
inline std::int32_t rounded_q31_product_in_thumb2(std::int32_t a, std::int32_t b) {
  std::int32_t result = 0;
  std::int32_t high = 0;
  // The last bit shifted out is the carry: it rounds.
  asm inline(
      "smull %[result], %[high], %[a], %[b]\n\t"
      "lsrs %[result], %[result], #31\n\t"
      "adc %[result], %[result], %[high], lsl #1"
      : [result] "=r"(result), [high] "=r"(high)
      : [a] "r"(a), [b] "r"(b)
      : "cc");
  return result;
}
#endif

/// As rounded_q31_product_of_halves(), by a wide product where the processor has one.
constexpr std::int32_t rounded_q31_product(std::int32_t a, std::int32_t b) {
#if defined(__thumb2__)
  if (!__builtin_is_constant_evaluated() && !__builtin_constant_p(a) && !__builtin_constant_p(b)) {
    return rounded_q31_product_in_thumb2(a, b);
  }
#endif
  if constexpr (has_wide_product) {
    return static_cast<std::int32_t>((std::int64_t{a} * b + (1 << 30)) >> 31);
  } else {
    return rounded_q31_product_of_halves(a, b);
  }
}

/// a b / 2^32, rounded down.
constexpr std::int32_t high_word_of_halves(std::int32_t a, std::int32_t b) {
  const auto [whole, rest] = narrow_product(a, b);
  return whole + (rest >> 16);
}

/// As high_word_of_halves(), by a wide product where the processor has one.
constexpr std::int32_t high_word(std::int32_t a, std::int32_t b) {
  if constexpr (has_wide_product) {
    return static_cast<std::int32_t>((std::int64_t{a} * b) >> 32);
  } else {
    return high_word_of_halves(a, b);
  }
}
constexpr std::uint32_t high_word(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint32_t>((std::uint64_t{a} * b) >> 32);
}

/// Bits up to the leading one of x > 0, by halving.
constexpr int width_by_halving(std::uint32_t x) {
  int width = 1;
  const auto halve = [&width, &x](int step) {
    if ((x >> step) != 0) {
      x >>= step;
      width += step;
    }
  };
  halve(16);
  halve(8);
  halve(4);
  halve(2);
  halve(1);
  return width;
}

/// As width_by_halving(), by an instruction where the processor has one.
constexpr int bit_width(std::uint32_t x) {
  return has_leading_zeros ? 32 - __builtin_clz(x) : width_by_halving(x);
}

/// 2^32 a / b, rounded down, a < b <= 2^31: bit by bit.
constexpr std::uint32_t fraction_by_bits(std::uint32_t a, std::uint32_t b) {
  std::uint32_t fraction = 0;
  for (int bit = 0; bit < 32; ++bit) {
    a *= 2;
    fraction *= 2;
    if (a >= b) {
      a -= b;
      ++fraction;
    }
  }
  return fraction;
}

/// The same by two digits of 16 bits, each from a division of words (Knuth 1998, algorithm D).
constexpr std::uint32_t fraction_by_halves(std::uint32_t a, std::uint32_t b) {
  const int unused = 32 - bit_width(b);
  a <<= unused;
  b <<= unused;
  const std::uint32_t high = b >> 16;
  const std::uint32_t low = b & 0xffff;
  std::uint32_t fraction = 0;
  for (int half = 0; half < 2; ++half) {
    std::uint32_t digit = a / high < 0xffff ? a / high : 0xffff;
    std::uint32_t rest = a - digit * high;
    while (rest <= 0xffff && digit * low > rest << 16) {
      --digit;
      rest += high;
    }
    a = (a << 16) - digit * b;
    fraction = (fraction << 16) + digit;
  }
  return fraction;
}

/// 2^31 a / b to nearest, b not 0: the quotient of two numbers with 31 fraction bits. Where |a| > |b|, any
/// number outside the range of the two, with the sign of the quotient. There is no tie: b would have to divide by
/// 2 as often as 2^32 a.
constexpr std::int64_t q31_quotient(std::int32_t a, std::int32_t b) {
  const bool negative = (a < 0) != (b < 0);
  const std::uint32_t dividend =
      a < 0 ? 0U - static_cast<std::uint32_t>(a) : static_cast<std::uint32_t>(a);
  const std::uint32_t divisor =
      b < 0 ? 0U - static_cast<std::uint32_t>(b) : static_cast<std::uint32_t>(b);
  if (dividend >= divisor) {
    const std::int64_t magnitude = std::int64_t{1} << (dividend == divisor ? 31 : 32);
    return negative ? -magnitude : magnitude;
  }
  const std::uint32_t fraction =
      has_division ? fraction_by_halves(dividend, divisor) : fraction_by_bits(dividend, divisor);
  const std::int64_t magnitude = (fraction >> 1) + (fraction & 1);
  return negative ? -magnitude : magnitude;
}

}  // namespace sonoglide::numeric
