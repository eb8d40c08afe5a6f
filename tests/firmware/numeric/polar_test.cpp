/// Modulus and direction, near roots and limited products against the library and wide integers.

#include "firmware/numeric/polar.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "firmware/numeric/near_root.hpp"
#include "ulp.hpp"

namespace sonoglide::numeric::polar_test {
namespace {

using Q = Q31<Trapping>;
constexpr int draws = 300'000;
constexpr long double unit = 0x1p-31L;

/// Pairs whose larger member is between 2^-lowest and 1.
class Pairs {
 public:
  explicit Pairs(double lowest) : size_(-lowest, 0.0) {}

  template <class Float>
  std::pair<Float, Float> next() {
    const double size = std::exp2(size_(random_));
    return {static_cast<Float>(part_(random_) * size), static_cast<Float>(part_(random_) * size)};
  }

 private:
  std::mt19937_64 random_{20132};
  std::uniform_real_distribution<double> part_{-1.0, 1.0};
  std::uniform_real_distribution<double> size_;
};

template <class Float>
class PolarOf : public testing::Test {};
using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(PolarOf, Floats);

TYPED_TEST(PolarOf, IsWithinFourUnitsOfTheLastPlace) {
  constexpr auto last_place = static_cast<long double>(std::numeric_limits<TypeParam>::epsilon());
  Pairs pairs(55.0);
  for (int i = 0; i < draws; ++i) {
    const auto [x, y] = pairs.template next<TypeParam>();
    const auto exact_x = static_cast<long double>(x);
    const auto exact_y = static_cast<long double>(y);
    const long double modulus = std::hypot(exact_x, exact_y);
    if (modulus < 0x1p-60L) {
      continue;
    }
    const Polar<TypeParam> found = polar(x, y);
    ASSERT_LE(error_in_ulp(found.modulus, modulus), 2.0) << x << ' ' << y;
    ASSERT_LE(error_in_ulp(found.inverse, 1.0L / modulus), 3.0) << x << ' ' << y;
    ASSERT_NEAR(static_cast<double>(found.cosine), static_cast<double>(exact_x / modulus),
                static_cast<double>(4.0L * last_place));
    ASSERT_NEAR(static_cast<double>(found.sine), static_cast<double>(exact_y / modulus),
                static_cast<double>(4.0L * last_place));
  }
}

TYPED_TEST(PolarOf, RootIsThatOfIeee754) {
  for (const TypeParam x : arguments<TypeParam>(1e-30, 1e30)) {
    ASSERT_EQ(near_root(x), std::sqrt(x)) << x;
  }
  EXPECT_EQ(near_root(TypeParam(0)), TypeParam(0));
}

TYPED_TEST(PolarOf, NothingHasTheDirectionOne) {
  const Polar<TypeParam> found = polar(TypeParam(0), TypeParam(0));
  EXPECT_EQ(found.modulus, TypeParam(0));
  EXPECT_EQ(found.cosine, TypeParam(1));
  EXPECT_EQ(found.sine, TypeParam(0));
  EXPECT_EQ(found.inverse, TypeParam(0));
}

/// Too small for polar() to see.
bool is_tiny(std::int32_t raw) {
  return -2 <= raw && raw <= 1;
}

void expect_near_in_fixed_point(std::int32_t a, std::int32_t b) {
  constexpr long double bound = 0x1p-23L;
  const long double modulus =
      std::hypot(static_cast<long double>(a), static_cast<long double>(b)) * unit;
  const Polar<Q> found = polar(Q::from_raw(a), Q::from_raw(b));
  const auto real = [](Q x) { return static_cast<long double>(x.raw()) * unit; };
  ASSERT_LE(std::abs(real(found.modulus) - std::min(modulus, 1.0L - unit)), bound * modulus + unit)
      << a << ' ' << b;
  ASSERT_LE(std::abs(real(found.cosine) - a * unit / modulus), bound) << a << ' ' << b;
  ASSERT_LE(std::abs(real(found.sine) - b * unit / modulus), bound) << a << ' ' << b;
  const long double inverse = std::ldexp(real(found.inverse.mantissa), found.inverse.up);
  ASSERT_LE(std::abs(inverse * modulus - 1.0L), bound + unit) << a << ' ' << b;
}

TEST(PolarInFixedPoint, IsNearWithoutAnOverflow) {
  Pairs pairs(31.0);
  for (int i = 0; i < draws; ++i) {
    const auto [x, y] = pairs.next<double>();
    const auto a = static_cast<std::int32_t>(x * 2147483647.0);
    const auto b = static_cast<std::int32_t>(y * 2147483647.0);
    if (!is_tiny(a) || !is_tiny(b)) {
      expect_near_in_fixed_point(a, b);
    }
  }
  for (const std::int32_t a : {INT32_MIN, -INT32_MAX, -3, 0, 2, INT32_MAX}) {
    for (const std::int32_t b : {INT32_MIN, -INT32_MAX, -3, 2, INT32_MAX}) {
      expect_near_in_fixed_point(a, b);
    }
  }
}

TEST(PolarInFixedPoint, OfNextToNothingAPartIsTwoUnits) {
  for (const std::int32_t a : {-2, -1, 0, 1}) {
    for (const std::int32_t b : {-2, -1, 0, 1}) {
      const Polar<Q> found = polar(Q::from_raw(a), Q::from_raw(b));
      const Polar<Q> two = polar(Q::from_raw(2), Q::from_raw(b));
      EXPECT_EQ(found.modulus, two.modulus);
      EXPECT_EQ(found.cosine, two.cosine);
      EXPECT_EQ(found.sine, two.sine);
    }
  }
  const Polar<Q> nothing = polar(Q{}, Q{});
  EXPECT_NEAR(nothing.modulus.raw(), 2, 1);
  EXPECT_NEAR(nothing.cosine.to_real(), 1.0, 0x1p-23);
  EXPECT_EQ(nothing.sine, Q{});
}

TEST(PolarInFixedPoint, RootIsNear) {
  for (const double x : arguments<double>(0.0, 0.9999999)) {
    const auto raw = static_cast<std::int32_t>(x * 2147483648.0);
    const long double wanted = std::sqrt(static_cast<long double>(raw) * unit);
    const long double found = static_cast<long double>(near_root(Q::from_raw(raw)).raw()) * unit;
    ASSERT_LE(std::abs(found - wanted), 0x1p-23L * wanted + unit) << raw;
  }
}

__extension__ using Wide = __int128;

/// x m 2^e of two raw numbers, rounded down at 31 fraction bits and limited.
std::int32_t limited(std::int32_t x, std::int32_t m, int e) {
  const Wide exact = static_cast<Wide>(x) * m;  // 62 fraction bits
  const int down = 31 - e;
  const Wide raw = down >= 0 ? exact >> std::min(down, 120) : exact * (Wide{1} << -down);
  const Wide most = INT32_MAX;
  return static_cast<std::int32_t>(std::clamp<Wide>(raw, -most, most));
}

TEST(LimitedProduct, IsTheProductWithinItsRounding) {
  std::mt19937_64 random(20133);
  for (int i = 0; i < draws; ++i) {
    const auto x = static_cast<std::int32_t>(random());
    const auto m = static_cast<std::int32_t>((random() & 0x3fffffffU) | 0x40000000U);
    const int e = static_cast<int>(random() % 80) - 40;
    if (x == INT32_MIN) {
      continue;
    }
    const std::int32_t found = limited_product(Q::from_raw(x), Split<Q>{Q::from_raw(m), e}).raw();
    // The product of the mantissas is rounded before it is shifted up.
    const double error = std::abs(static_cast<double>(found) - limited(x, m, e));
    ASSERT_LE(error, e > 0 && e < 31 ? std::ldexp(1.0, e) + 1.0 : 2.0) << x << ' ' << m << ' ' << e;
  }
}

TEST(LimitedProduct, OfFloatingPointIsTheProduct) {
  EXPECT_EQ(limited_product(0.375, 8.0), 3.0);
  EXPECT_EQ(limited_product(-0.375F, 8.0F), -3.0F);
}

}  // namespace
}  // namespace sonoglide::numeric::polar_test
