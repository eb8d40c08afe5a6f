/// Products, widths and quotients in words, against 64-bit and long double arithmetic.

#include "firmware/numeric/floating.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "firmware/numeric/word.hpp"

namespace sonoglide::numeric::floating_test {
namespace {

using Number = Q31<Trapping>;

/// Words that are random, or next to an end or to a half of the range.
class Words {
 public:
  std::int32_t next() {
    const auto word = static_cast<std::uint32_t>(random_());
    const std::uint32_t near = (word & 0xffU) - 128U;
    switch (word >> 30) {
      case 0:
        return static_cast<std::int32_t>((1U << 31) + near);
      case 1:
        return static_cast<std::int32_t>((word & 0xc0000000U) + near * 0x8000U);
      default:
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(random_()));
    }
  }

  /// A mantissa in [1/2, 1).
  Number mantissa() {
    const auto word = static_cast<std::uint32_t>(next()) >> 2;
    return Number::from_raw(static_cast<std::int32_t>((1U << 30) + word));
  }

 private:
  std::mt19937_64 random_{15};
};

TEST(WordProduct, OfHalvesIsTheRoundedWideProduct) {
  Words words;
  for (int i = 0; i < 1'000'000; ++i) {
    const std::int32_t a = words.next();
    const std::int32_t b = words.next();
    if (a != INT32_MIN || b != INT32_MIN) {
      const std::int64_t wide = shift_right_rounded(std::int64_t{a} * b, 31);
      ASSERT_EQ(rounded_q31_product_of_halves(a, b), wide) << a << " * " << b;
      ASSERT_EQ(rounded_q31_product(a, b), wide) << a << " * " << b;
    }
  }
}

__extension__ using Wide = __int128;

/// floor(2^31 a / b + 1/2) in 128 bits.
std::int64_t rounded_quotient(std::int32_t a, std::int32_t b) {
  const Wide sign = b < 0 ? -1 : 1;
  const Wide dividend = sign * a * (Wide{1} << 32) + sign * b;
  const Wide divisor = 2 * sign * b;
  const Wide quotient = dividend / divisor;
  return static_cast<std::int64_t>(quotient - (dividend % divisor < 0 ? 1 : 0));
}

TEST(WordQuotient, IsTheRoundedOne) {
  Words words;
  const std::int32_t ends[] = {INT32_MIN, INT32_MIN + 1, -3,       -2, -1, 1, 2, 3,
                               5,         INT32_MAX - 1, INT32_MAX};
  const auto expect_rounded = [](std::int32_t a, std::int32_t b) {
    const std::int64_t expected = rounded_quotient(a, b);
    const std::int64_t found = q31_quotient(a, b);
    if (std::int64_t{INT32_MIN} <= expected && expected <= INT32_MAX) {
      ASSERT_EQ(found, expected) << a << " / " << b;
    } else {
      ASSERT_TRUE(expected < 0 ? found < INT32_MIN : found > INT32_MAX) << a << " / " << b;
    }
  };
  for (int i = 0; i < 1'000'000; ++i) {
    const std::int32_t a = words.next();
    const std::int32_t b = words.next() >> (i % 31);
    if (b != 0) {
      expect_rounded(a >> (i / 31 % 31), b);
      expect_rounded(b / 2, b);  // near a tie
    }
  }
  for (const std::int32_t a : ends) {
    for (const std::int32_t b : ends) {
      expect_rounded(a, b);
      expect_rounded(0, b);
    }
  }
}

TEST(WordQuotient, ByBitsAndByHalvesIsTheSameFraction) {
  Words words;
  for (int i = 0; i < 1'000'000; ++i) {
    const auto x = static_cast<std::uint32_t>(words.next()) >> (1 + i % 31);
    const auto y = static_cast<std::uint32_t>(words.next()) >> (1 + i / 31 % 31);
    const auto [a, b] = std::minmax(x, y);
    if (a < b) {
      const auto exact = static_cast<std::uint32_t>((std::uint64_t{a} << 32) / b);
      ASSERT_EQ(fraction_by_bits(a, b), exact) << a << " / " << b;
      ASSERT_EQ(fraction_by_halves(a, b), exact) << a << " / " << b;
    }
    constexpr std::uint32_t highest = 1U << 31;
    ASSERT_EQ(fraction_by_bits(x, highest), 2 * x);
    ASSERT_EQ(fraction_by_halves(x, highest), 2 * x);
  }
}

TEST(WordWidth, ByHalvingIsThatOfTheLeadingOne) {
  for (int width = 1; width <= 32; ++width) {
    const std::uint32_t leading = 1U << (width - 1);
    for (const std::uint32_t x : {leading, leading + leading / 3U, leading + (leading - 1U)}) {
      EXPECT_EQ(width_by_halving(x), width);
      EXPECT_EQ(bit_width(x), width);
    }
  }
}

long double value(const Split<Number>& x) {
  return std::ldexp(static_cast<long double>(x.mantissa.to_real()), x.exponent);
}

TEST(FloatingFixed, ProductsAreRoundedOnce) {
  Words words;
  for (int i = 0; i < 300'000; ++i) {
    const Split<Number> a{words.mantissa(), 3};
    const Split<Number> b{words.mantissa(), -7};
    const Split<Number> result = product(a, b);
    ASSERT_GE(result.mantissa.raw(), 1 << 30);
    const long double exact = value(a) * value(b);
    ASSERT_LE(std::abs(value(result) - exact), 0x1p-32L * 0x1p-4L);
  }
}

TEST(FloatingFixed, QuotientsAreTooSmallByAtMostTheStatedPart) {
  Words words;
  for (int i = 0; i < 1'000'000; ++i) {
    const Split<Number> a{words.mantissa(), 5};
    const Split<Number> b{words.mantissa(), 9};
    const Split<Number> result = quotient(a, b);
    ASSERT_GE(result.mantissa.raw(), 1 << 30);
    const long double short_by = 1.0L - value(result) * value(b) / value(a);
    ASSERT_GE(short_by, 0.0L) << a.mantissa.raw() << " / " << b.mantissa.raw();
    ASSERT_LE(short_by, 0x1p-23L) << a.mantissa.raw() << " / " << b.mantissa.raw();
  }
}

TEST(FloatingFixed, ReciprocalIsTheQuotientRoundedDown) {
  for (std::uint32_t d = (1U << 15) + 1; d <= 1U << 16; ++d) {
    ASSERT_EQ(reciprocal_by_newton(d), (1U << 31) / d);
  }
}

TEST(FloatingFixed, MultiplesAreTooSmallByTheStatedUnitsOrLimited) {
  Words words;
  for (int i = 0; i < 300'000; ++i) {
    const Split<Number> factor{words.mantissa(), i % 40};
    const Number x = Number::from_raw((i % 2 == 0 ? 1 : -1) * (words.mantissa().raw() >> (i % 29)));
    const auto ready = multiple(factor);
    const long double largest = static_cast<long double>(Number::largest().to_real());
    const long double exact = std::ldexp(
        static_cast<long double>(x.to_real()) * static_cast<long double>(factor.mantissa.to_real()),
        std::min(factor.exponent, 30));
    const long double short_by = std::clamp(exact, -largest, largest) -
                                 static_cast<long double>(multiplied(x, ready).to_real());
    ASSERT_GE(short_by, -0x1p-31L);
    ASSERT_LT(short_by, std::ldexp(1.0L, ready.up + 1 - 31));
  }
}

TEST(FloatingFixed, LimitedValueIsRoundedDownToAUnit) {
  Words words;
  for (int i = 0; i < 10'000; ++i) {
    const Split<Number> factor{words.mantissa(), i % 50 - 45};
    const auto found = static_cast<long double>(limited_value(factor).to_real());
    if (factor.exponent > 0) {
      ASSERT_EQ(found, static_cast<long double>(Number::largest().to_real()));
    } else {
      ASSERT_LE(found, value(factor));
      ASSERT_LT(value(factor) - found, 0x1p-31L);
    }
  }
}

TEST(FloatingFloat, IsTheNumberItself) {
  EXPECT_EQ(floating(0.375F), 0.375F);
  EXPECT_EQ(floating(Split<double>{0.75, 4}), 12.0);
  EXPECT_EQ(product(3.0, 0.5), 1.5);
  EXPECT_EQ(quotient(3.0F, 2.0F), 1.5F);
  EXPECT_EQ(multiplied(0.75F, multiple(16.0F)), 12.0F);
  EXPECT_EQ(limited_value(3.0), 3.0);
}

TEST(FloatingShort, ProductsAreTooSmallByAtMostTheStatedPart) {
  using Short = Q15<Trapping>;
  for (int a = 1 << 14; a < 1 << 15; a += 37) {
    for (int b = 1 << 14; b < 1 << 15; b += 41) {
      const Split<Short> result =
          product(Split<Short>{Short::from_raw(static_cast<std::int16_t>(a)), 2},
                  Split<Short>{Short::from_raw(static_cast<std::int16_t>(b)), -5});
      const double exact = std::ldexp(static_cast<double>(a) * b, -30 - 3);
      const double found = std::ldexp(result.mantissa.to_real(), result.exponent);
      ASSERT_GE(result.mantissa.raw(), 1 << 14);
      ASSERT_LE(found, exact);
      ASSERT_GE(found, exact * (1.0 - 0x1p-14));
    }
  }
}

TEST(FloatingFixed, IsRescaledExactly) {
  const auto rescaled_fixed = rescaled(Split<Number>{Number::from_real(0.75), 3}, -5);
  EXPECT_EQ(rescaled_fixed.mantissa.to_real(), 0.75);
  EXPECT_EQ(rescaled_fixed.exponent, -2);
  EXPECT_EQ(rescaled(0.75F, -2), 0.1875F);
}

}  // namespace
}  // namespace sonoglide::numeric::floating_test
