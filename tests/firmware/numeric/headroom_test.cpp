/// Products and sums with headroom against exact integers, and magnitudes that are limited.

#include "firmware/numeric/headroom.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <type_traits>

#include "firmware/numeric/word.hpp"

namespace sonoglide::numeric::headroom_test {
namespace {

/// Under this policy any overflow ends the test.
using Q = Q31<Trapping>;
using Short = Q15<Trapping>;
constexpr int draws = 200'000;

/// Codes of any size, and the ends of the range.
template <class Fixed>
class Codes {
 public:
  Fixed next() {
    const auto bits = static_cast<std::uint32_t>(random_());
    constexpr int width = 8 * sizeof(typename Fixed::Raw);
    if (bits % 32 == 0) {
      return std::array{Fixed::lowest(), Fixed::largest(), Fixed{},
                        Fixed::from_raw(-1)}[(bits >> 8) % 4];
    }
    return Fixed::from_raw(static_cast<typename Fixed::Raw>(
        static_cast<std::int32_t>(bits) >> (32 - width + static_cast<int>(random_() % width))));
  }

 private:
  std::mt19937 random_{20136};
};

/// In units of the last place.
template <class Fixed>
long double units(Fixed x) {
  return static_cast<long double>(x.raw());
}
/// Of a product of two numbers in these units.
template <class Fixed>
long double product(Fixed a, Fixed b) {
  return std::ldexp(units(a) * units(b), -Fixed::fraction_bits);
}

template <class Fixed>
class HeadroomOf : public testing::Test {};
using Numbers = testing::Types<Q, Short>;
TYPED_TEST_SUITE(HeadroomOf, Numbers);

TYPED_TEST(HeadroomOf, HalvesAreWithinTheirRounding) {
  Codes<TypeParam> codes;
  for (int i = 0; i < draws; ++i) {
    const TypeParam a = codes.next();
    const TypeParam b = codes.next();
    const long double sum = (units(a) + units(b)) / 2 - units(half_sum(a, b));
    ASSERT_TRUE(sum >= 0.0L && sum <= 1.0L) << a.raw() << ' ' << b.raw();
    const long double difference = (units(a) - units(b)) / 2 - units(half_difference(a, b));
    ASSERT_LE(std::abs(difference), 0.5L) << a.raw() << ' ' << b.raw();
    const long double times = product(a, b) / 2 - units(half_product(a, b));
    ASSERT_TRUE(times >= 0.0L && times < 1.0L) << a.raw() << ' ' << b.raw();
  }
}

TYPED_TEST(HeadroomOf, RoughProductIsTooSmallByLessThanTwoUnits) {
  Codes<TypeParam> codes;
  for (int i = 0; i < draws; ++i) {
    const TypeParam a = codes.next();
    const TypeParam b = codes.next();
    if (a == TypeParam::lowest() && b == TypeParam::lowest()) {
      continue;
    }
    const long double error = product(a, b) - units(rough_product(a, b));
    ASSERT_TRUE(error >= 0.0L && error < 2.0L) << a.raw() << ' ' << b.raw();
  }
}

TYPED_TEST(HeadroomOf, BoundedProductIsThatOfTheOperator) {
  Codes<TypeParam> codes;
  for (int i = 0; i < draws; ++i) {
    const TypeParam a = codes.next();
    const TypeParam b = codes.next();
    if (a != TypeParam::lowest() || b != TypeParam::lowest()) {
      ASSERT_EQ(bounded_product(a, b), a * b) << a.raw() << ' ' << b.raw();
    }
  }
}

TYPED_TEST(HeadroomOf, SumsOfProductsAreWithinTheirRounding) {
  using Saturated = Fixed<typename TypeParam::Raw, TypeParam::fraction_bits, Saturating>;
  Codes<Saturated> codes;
  for (int i = 0; i < draws; ++i) {
    const Saturated a = codes.next();
    const Saturated b = codes.next();
    const Saturated c = codes.next();
    const Saturated d = codes.next();
    const auto limited = [](long double exact) {
      return std::clamp(exact, units(Saturated::lowest()), units(Saturated::largest()));
    };
    const long double sum =
        limited(product(a, b) + product(c, d)) - units(sum_of_products(a, b, c, d));
    ASSERT_TRUE(sum >= 0.0L && sum < 4.0L);
    const long double difference =
        limited(product(a, b) - product(c, d)) - units(difference_of_products(a, b, c, d));
    ASSERT_TRUE(difference > -2.0L && difference < 2.0L);
    const int n = i % 12;
    const long double lift = std::ldexp(1.0L, n);
    const long double lifted_error =
        limited(lift * (product(a, b) + product(c, d))) - units(lifted_sum(a, b, c, d, n));
    ASSERT_TRUE(lifted_error >= -1.0L && lifted_error < 4.0L * lift) << n;
  }
}

TYPED_TEST(HeadroomOf, WhatIsKeptIsHalf) {
  Codes<TypeParam> codes;
  for (int i = 0; i < draws; ++i) {
    const TypeParam a = codes.next();
    const TypeParam b = codes.next();
    ASSERT_EQ(kept_sum(a, b), half_sum(a, b));
    ASSERT_EQ(kept_difference(a, b), half_difference(a, b));
    ASSERT_EQ(kept_product(a, b), half_product(a, b));
    if (a != TypeParam::lowest() || b != TypeParam::lowest()) {
      const long double squares =
          (product(a, a) + product(b, b)) / 2 - units(kept_square_sum(a, b));
      ASSERT_TRUE(squares >= 0.0L && squares < 2.0L) << a.raw() << ' ' << b.raw();
    }
  }
  EXPECT_EQ(kept<TypeParam>(0.5), from_real<TypeParam>(0.25));
  EXPECT_EQ(kept_of(from_real<TypeParam>(0.5)), from_real<TypeParam>(0.25));
}

TYPED_TEST(HeadroomOf, DifferenceWithALiftedProductIsLimitedAndWithinItsRounding) {
  Codes<TypeParam> codes;
  for (int i = 0; i < draws; ++i) {
    const TypeParam a = codes.next();
    const TypeParam b = codes.next();
    const TypeParam c = codes.next();
    const TypeParam d = codes.next();
    const int n = i % 12;
    const long double lift = std::ldexp(1.0L, n);
    const long double one = -units(TypeParam::lowest());
    const long double exact = (product(a, b) - std::clamp(lift * product(c, d), -one, one)) / 2;
    const long double found = units(difference_with_lifted(a, b, c, d, n));
    ASSERT_LE(std::abs(exact - found), 2.0L * lift) << n;
  }
}

TYPED_TEST(HeadroomOf, RaisedIsExactOrOverflowsByPolicy) {
  using Saturated = Fixed<typename TypeParam::Raw, TypeParam::fraction_bits, Saturating>;
  Codes<Saturated> codes;
  for (int i = 0; i < draws; ++i) {
    const Saturated x = codes.next();
    const int n = i % (TypeParam::fraction_bits + 1);
    ASSERT_EQ(units(raised(x, n)), std::clamp(std::ldexp(units(x), n), units(Saturated::lowest()),
                                              units(Saturated::largest())));
  }
}

TEST(HeadroomOfFloats, KeepsAllOfANumber) {
  EXPECT_EQ(kept<float>(0.5), 0.5F);
  EXPECT_EQ(kept_of(0.5F), 0.5F);
  EXPECT_EQ(kept_sum(0.5F, 0.25F), 0.75F);
  EXPECT_EQ(kept_difference(0.5, 0.25), 0.25);
  EXPECT_EQ(kept_product(0.5, 0.25), 0.125);
  EXPECT_EQ(kept_square_sum(3.0, 4.0), 25.0);
  EXPECT_EQ(difference_with_lifted(3.0, 4.0, 5.0, 2.0, 7), 2.0);
}

TYPED_TEST(HeadroomOf, LiftedIsExactOrAnEndOfTheRange) {
  Codes<TypeParam> codes;
  for (int i = 0; i < draws; ++i) {
    const TypeParam x = codes.next();
    const int n = i % (TypeParam::fraction_bits + 1);
    const long double exact = std::ldexp(units(x), n);
    const long double most = units(TypeParam::largest());
    const long double found = units(lifted(x, n));
    if (std::abs(exact) <= most) {
      ASSERT_EQ(found, exact) << x.raw() << ' ' << n;
    } else {
      ASSERT_LE(std::abs(found - std::clamp(exact, -most, most)), 1.0L) << x.raw() << ' ' << n;
    }
    ASSERT_EQ(limited_lift(x, n), lifted(x, n));
  }
}

TYPED_TEST(HeadroomOf, SignsAreThoseOfTheProduct) {
  Codes<TypeParam> codes;
  for (int i = 0; i < draws; ++i) {
    const TypeParam a = codes.next();
    const TypeParam b = codes.next();
    const long double exact = product(a, b);
    ASSERT_EQ(opposite_signs(a, b), exact < 0.0L) << a.raw() << ' ' << b.raw();
    ASSERT_EQ(same_sign(a, b), exact > 0.0L) << a.raw() << ' ' << b.raw();
  }
}

TEST(Headroom, OfFloatingPointIsPlainArithmetic) {
  EXPECT_EQ(half_sum(0.5, 0.25), 0.375);
  EXPECT_EQ(half_difference(0.5F, 0.25F), 0.125F);
  EXPECT_EQ(half_product(0.5, 0.5), 0.125);
  EXPECT_EQ(rough_product(0.5F, 0.5F), 0.25F);
  EXPECT_EQ(lifted(3.0, 4), 3.0);
  EXPECT_EQ(limited_lift(0.25, 1), 0.5);
  EXPECT_EQ(limited_lift(-0.25F, 3), -1.0F);
  EXPECT_EQ(lifted_sum(0.5, 0.5, 0.25, 4.0, 3), 1.25);
  EXPECT_EQ(sum_of_products(0.5, 0.5, 0.25, 4.0), 1.25);
  EXPECT_EQ(difference_of_products(0.5, 0.5, 0.25, 4.0), -0.75);
  EXPECT_TRUE(same_sign(-1.0, -2.0));
  EXPECT_FALSE(same_sign(0.0, 2.0));
  EXPECT_TRUE(opposite_signs(-1.0F, 2.0F));
  EXPECT_FALSE(opposite_signs(-1.0F, 0.0F));
}

TEST(Headroom, MagnitudesAreLimited) {
  EXPECT_EQ(clamp_magnitude(0.3, 0.5), 0.3);
  EXPECT_EQ(clamp_magnitude(0.7F, 0.5F), 0.5F);
  EXPECT_EQ(clamp_magnitude(-0.7, 0.5), -0.5);
  EXPECT_TRUE(std::isnan(clamp_magnitude(std::nan(""), 0.5)));
}

TEST(Headroom, HighWordsAreThoseOfTheWideProduct) {
  std::mt19937 random(20137);
  for (int i = 0; i < draws; ++i) {
    const auto a = static_cast<std::int32_t>(random());
    const auto b = static_cast<std::int32_t>(random());
    const std::int64_t wide = std::int64_t{a} * b;
    ASSERT_EQ(high_word(a, b), wide >> 32);
    ASSERT_EQ(high_word_of_halves(a, b), wide >> 32);
  }
  for (const std::int32_t a : {INT32_MIN, -1, 0, 1, INT32_MAX}) {
    for (const std::int32_t b : {INT32_MIN, -1, 0, 1, INT32_MAX}) {
      ASSERT_EQ(high_word_of_halves(a, b), (std::int64_t{a} * b) >> 32);
    }
  }
}

}  // namespace
}  // namespace sonoglide::numeric::headroom_test
