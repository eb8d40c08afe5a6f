/// The stated error bounds of the floating-point functions, against long double.

#include "firmware/numeric/float_elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "tests/common/constants/pi.hpp"
#include "ulp.hpp"

namespace sonoglide::numeric::float_elementary_test {
namespace {

using tests::long_pi;

/// sin(pi x), the reduction to an eighth of a turn being exact.
long double reference_sin_pi(long double x) {
  const long double quarter_turns = std::round(2 * x);
  const long double angle = long_pi * (x - quarter_turns / 2);
  const auto quadrant = static_cast<long long>(quarter_turns) & 3;
  const long double magnitude = (quadrant & 1) != 0 ? std::cos(angle) : std::sin(angle);
  return (quadrant & 2) != 0 ? -magnitude : magnitude;
}

template <class Float>
class FloatElementary : public testing::Test {
 protected:
  static constexpr bool is_double = std::is_same_v<Float, double>;
  static constexpr Float infinity = std::numeric_limits<Float>::infinity();
  static constexpr Float nan = std::numeric_limits<Float>::quiet_NaN();
};

using Formats = testing::Types<float, double>;
TYPED_TEST_SUITE(FloatElementary, Formats, );

TYPED_TEST(FloatElementary, SineAndCosineAreWithin3Ulp) {
  const double far = TestFixture::is_double ? 1e6 : 1e4;
  for (const double bound : {1.0, 10.0, 1e4, far}) {
    const auto at = arguments<TypeParam>(-bound, bound);
    EXPECT_LE(
        worst_ulp(
            at, [](TypeParam x) { return sin(x); }, [](long double x) { return std::sin(x); }),
        3.0);
    EXPECT_LE(
        worst_ulp(
            at, [](TypeParam x) { return cos(x); }, [](long double x) { return std::cos(x); }),
        3.0);
  }
}

TYPED_TEST(FloatElementary, SineAndCosineAreWithin3UlpNextToTheirZeros) {
  std::vector<TypeParam> at;
  for (int n = 1; n < 6000; ++n) {
    const auto nearest = static_cast<TypeParam>(n * (long_pi / 2));
    at.push_back(std::nextafter(nearest, TypeParam{0}));
    at.push_back(nearest);
    at.push_back(std::nextafter(nearest, this->infinity));
  }
  EXPECT_LE(worst_ulp(
                at, [](TypeParam x) { return sin(x); }, [](long double x) { return std::sin(x); }),
            3.0);
  EXPECT_LE(worst_ulp(
                at, [](TypeParam x) { return cos(x); }, [](long double x) { return std::cos(x); }),
            3.0);
}

TYPED_TEST(FloatElementary, SineAndCosineOfHalfTurnsAreWithin2AndAHalfUlp) {
  for (const double bound : {1.0, 2.0, TestFixture::is_double ? 0x1p30 : 0x1p21}) {
    const auto at = arguments<TypeParam>(-bound, bound);
    EXPECT_LE(worst_ulp(
                  at, [](TypeParam x) { return sin_pi(x); }, reference_sin_pi),
              2.5);
    EXPECT_LE(worst_ulp(
                  at, [](TypeParam x) { return cos_pi(x); },
                  [](long double x) { return reference_sin_pi(x + 0.5L); }),
              2.5);
  }
}

TYPED_TEST(FloatElementary, SineAndCosineOfHalfTurnsAreExactOnTheAxes) {
  for (int n = -1000; n <= 1000; ++n) {
    const TypeParam axis[] = {0, 1, 0, -1};
    const auto x = static_cast<TypeParam>(n) / 2;
    EXPECT_EQ(sin_pi(x), axis[n & 3]);
    EXPECT_EQ(cos_pi(x), axis[(n + 1) & 3]);
  }
}

TYPED_TEST(FloatElementary, ExponentialIsWithin1Ulp) {
  const double low = TestFixture::is_double ? -745.5 : -104.5;
  const double high = TestFixture::is_double ? 710.0 : 89.0;
  for (const auto& at : {arguments<TypeParam>(-1.0, 1.0), arguments<TypeParam>(low, high)}) {
    EXPECT_LE(
        worst_ulp(
            at, [](TypeParam x) { return exp(x); }, [](long double x) { return std::exp(x); }),
        1.0);
  }
}

TYPED_TEST(FloatElementary, ExponentialMinusOneIsWithin2Ulp) {
  const double high = TestFixture::is_double ? 710.0 : 89.0;
  for (const auto& at : {arguments<TypeParam>(-1.0, 1.0), arguments<TypeParam>(-60.0, high)}) {
    EXPECT_LE(
        worst_ulp(
            at, [](TypeParam x) { return expm1(x); }, [](long double x) { return std::expm1(x); }),
        2.0);
  }
}

TYPED_TEST(FloatElementary, PowerOfTwoIsWithin1AndAHalfUlp) {
  const double low = TestFixture::is_double ? -1080.0 : -155.0;
  const double high = TestFixture::is_double ? 1025.0 : 129.0;
  for (const auto& at : {arguments<TypeParam>(-1.0, 1.0), arguments<TypeParam>(low, high)}) {
    EXPECT_LE(
        worst_ulp(
            at, [](TypeParam x) { return exp2(x); }, [](long double x) { return std::exp2(x); }),
        1.5);
  }
}

TYPED_TEST(FloatElementary, BinaryLogarithmIsWithin2Ulp) {
  const double largest = static_cast<double>(std::numeric_limits<TypeParam>::max());
  for (const auto& at : {arguments<TypeParam>(0.0, 2.0), arguments<TypeParam>(0.7, 1.5),
                         arguments<TypeParam>(0.999, 1.001), arguments<TypeParam>(0.0, largest)}) {
    EXPECT_LE(
        worst_ulp(
            at, [](TypeParam x) { return log2(x); }, [](long double x) { return std::log2(x); }),
        2.0);
  }
}

TYPED_TEST(FloatElementary, BinaryLogarithmAndPowerOfTwoAreExactForWholeExponents) {
  using Limits = std::numeric_limits<TypeParam>;
  for (int n = Limits::min_exponent - Limits::digits; n < Limits::max_exponent; ++n) {
    const TypeParam power = std::ldexp(TypeParam{1}, n);
    EXPECT_EQ(exp2(static_cast<TypeParam>(n)), power);
    EXPECT_EQ(log2(power), static_cast<TypeParam>(n));
  }
}

TYPED_TEST(FloatElementary, InverseFunctionsAreWithinTheirBounds) {
  for (const auto& at : {arguments<TypeParam>(-1.0, 1.0), arguments<TypeParam>(0.4, 0.6),
                         arguments<TypeParam>(0.999, 1.0)}) {
    EXPECT_LE(
        worst_ulp(
            at, [](TypeParam x) { return asin(x); }, [](long double x) { return std::asin(x); }),
        3.0);
    EXPECT_LE(
        worst_ulp(
            at, [](TypeParam x) { return acos(x); }, [](long double x) { return std::acos(x); }),
        2.0);
    EXPECT_LE(worst_ulp(
                  at, [](TypeParam x) { return asin_per_pi(x); },
                  [](long double x) { return std::asin(x) / long_pi; }),
              4.0);
  }
  EXPECT_EQ(asin_per_pi(TypeParam{1}), static_cast<TypeParam>(0.5));
  EXPECT_EQ(asin_per_pi(TypeParam{-1}), static_cast<TypeParam>(-0.5));
}

TYPED_TEST(FloatElementary, SquareRootHasTheBitsOfIeee754) {
  std::mt19937_64 random(7);
  std::int64_t wrong = 0;
  for (int i = 0; i < 2'000'000; ++i) {
    const auto bits = static_cast<FloatBits<TypeParam>>(random()) >> 1;
    const TypeParam x = from_bits<TypeParam>(bits);
    const TypeParam wanted = std::sqrt(x);
    wrong += sqrt(x) == wanted || std::isnan(wanted) ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0);
}

TEST(FloatSquareRoot, HasTheBitsOfIeee754ForEveryMantissa) {
  std::int64_t wrong = 0;
  for (std::uint32_t bits = 0x3F800000; bits < 0x40800000; ++bits) {  // [1, 4)
    const float x = from_bits<float>(bits);
    wrong += sqrt(x) == std::sqrt(x) ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0);
}

TYPED_TEST(FloatElementary, EndsAreThoseOfIeee754) {
  const TypeParam zero{0};
  EXPECT_EQ(exp(-this->infinity), zero);
  EXPECT_EQ(exp(this->infinity), this->infinity);
  EXPECT_EQ(exp2(-this->infinity), zero);
  EXPECT_EQ(exp2(this->infinity), this->infinity);
  EXPECT_EQ(expm1(-this->infinity), TypeParam{-1});
  EXPECT_EQ(expm1(this->infinity), this->infinity);
  EXPECT_EQ(log2(zero), -this->infinity);
  EXPECT_EQ(log2(this->infinity), this->infinity);
  EXPECT_EQ(sqrt(this->infinity), this->infinity);
  EXPECT_EQ(sqrt(zero), zero);
}

TYPED_TEST(FloatElementary, OutsideTheDomainIsNan) {
  const TypeParam beyond = std::nextafter(TypeParam{1}, TypeParam{2});
  for (const TypeParam x : {beyond, -beyond, this->infinity, -this->infinity, this->nan}) {
    EXPECT_TRUE(std::isnan(asin(x)));
    EXPECT_TRUE(std::isnan(acos(x)));
    EXPECT_TRUE(std::isnan(asin_per_pi(x)));
  }
  for (const TypeParam x :
       {TypeParam{-1}, -std::numeric_limits<TypeParam>::denorm_min(), -this->infinity, this->nan}) {
    EXPECT_TRUE(std::isnan(sqrt(x)));
    EXPECT_TRUE(std::isnan(log2(x)));
  }
  for (const TypeParam x : {this->infinity, -this->infinity, this->nan, -this->nan}) {
    EXPECT_TRUE(std::isnan(sin(x)));
    EXPECT_TRUE(std::isnan(cos(x)));
    EXPECT_TRUE(std::isnan(sin_pi(x)));
    EXPECT_TRUE(std::isnan(cos_pi(x)));
  }
  for (const TypeParam x : {this->nan, -this->nan}) {
    EXPECT_TRUE(std::isnan(exp(x)));
    EXPECT_TRUE(std::isnan(exp2(x)));
    EXPECT_TRUE(std::isnan(expm1(x)));
  }
}

}  // namespace
}  // namespace sonoglide::numeric::float_elementary_test
