/// The scalar interface: the same questions to double, float and fixed point.

#include "firmware/numeric/scalar.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace sonoglide::numeric::scalar_test {
namespace {

using Long = Q31<Saturating>;
using Short = Q15<Saturating>;
using Mixed = Fixed<std::int32_t, 16, Saturating>;

static_assert(is_fixed_point_v<Long> && is_fixed_point_v<Short>);
static_assert(!is_fixed_point_v<float> && !is_fixed_point_v<double>);
static_assert(from_real<Long>(0.25).raw() == 1 << 29 && from_real<float>(0.25) == 0.25F);

template <class Scalar>
class EveryScalar : public testing::Test {};

using Scalars = testing::Types<float, double, Long, Short, Mixed>;
TYPED_TEST_SUITE(EveryScalar, Scalars, );

TYPED_TEST(EveryScalar, AnswersTheSame) {
  const auto x = from_real<TypeParam>(0.375);
  const auto y = from_real<TypeParam>(-0.5);
  EXPECT_EQ(to_real(abs(y)), 0.5);
  EXPECT_EQ(abs(x), x);
  EXPECT_EQ(min(x, y), y);
  EXPECT_EQ(max(x, y), x);
  EXPECT_EQ(clamp(x, y, TypeParam{}), TypeParam{});
  EXPECT_EQ(clamp(y, TypeParam{}, x), TypeParam{});
  EXPECT_EQ(clamp(x, y, x), x);
  EXPECT_TRUE(is_finite(x));
  EXPECT_EQ(to_real(twice(x)), 0.75);
  EXPECT_EQ(to_real(half(y)), -0.25);
  EXPECT_EQ(to_real(scale_by_power_of_two(x, 1)), 0.75);
  EXPECT_EQ(to_real(scale_by_power_of_two(x, -3)), 0.046875);
  EXPECT_EQ(to_real(split(half(x)).mantissa), 0.75);
  EXPECT_EQ(split(half(x)).exponent, -2);
  EXPECT_EQ(to_code(x), 3 << 28);
  EXPECT_EQ(from_code<TypeParam>(-(1 << 30)), y);
  const std::array<TypeParam, 2> vector{x, y};
  EXPECT_EQ(to_real(dot(vector, vector)), 0.390625);
}

TYPED_TEST(EveryScalar, IsBelowHasBothEndsOfItsRange) {
  const auto high = from_real<TypeParam>(0.375);
  for (const double value : {-1.0, -0.5, -0.001, 0.0, 0.001, 0.25, 0.374, 0.375, 0.376, 0.75}) {
    const auto x = from_real<TypeParam>(value);
    EXPECT_EQ(is_below(x, high), value >= 0.0 && x < high) << value;
    EXPECT_EQ(clamp_positive(x, high), clamp(x, TypeParam{}, high)) << value;
    EXPECT_EQ(is_negative(x), x < TypeParam{}) << value;
    EXPECT_EQ(reaches(x, high), high <= x) << value;
  }
}

TEST(FloatScalar, IsBelowIsFalseForTheNegativeZeroAndNan) {
  EXPECT_FALSE(is_below(-0.0F, 0.5F));
  EXPECT_FALSE(is_below(std::numeric_limits<float>::quiet_NaN(), 0.5F));
  EXPECT_FALSE(is_below(-std::numeric_limits<double>::infinity(), 0.5));
  EXPECT_TRUE(is_negative(-0.0F) && is_negative(-0.0));
  EXPECT_TRUE(std::signbit(clamp_positive(-0.0F, 0.5F)));
  EXPECT_TRUE(std::isnan(clamp_positive(std::numeric_limits<float>::quiet_NaN(), 0.5F)));
}

TEST(FloatScalar, ReachesIsTheComparisonAtTheEndsToo) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {-infinity, -1e300, -0x1p-1074, -0.0, 0.0, 0x1p-1074, 1e300, infinity}) {
    for (const double level : {0x1p-1074, 0.5, 1e300, infinity}) {
      EXPECT_EQ(reaches(x, level), level <= x) << x << " " << level;
    }
  }
}

TYPED_TEST(EveryScalar, SplitLeavesZeroAndNegativeNumbersWhole) {
  for (const double value : {0.0, -0.5}) {
    const auto parts = split(from_real<TypeParam>(value));
    EXPECT_EQ(to_real(parts.mantissa), value);
    EXPECT_EQ(parts.exponent, 0);
  }
}

TEST(FixedScalar, TheLargestCodeIsTheLargestNumberAndNoOverflow) {
  EXPECT_EQ(from_code<Q15<Trapping>>(INT32_MAX), Q15<Trapping>::largest());
  EXPECT_EQ(from_code<Q31<Trapping>>(INT32_MAX), Q31<Trapping>::largest());
  EXPECT_EQ(from_code<Q15<Trapping>>(INT32_MIN), Q15<Trapping>::lowest());
}

TEST(FixedScalar, HalfRoundsTiesUpward) {
  EXPECT_EQ(half(Long::from_raw(3)).raw(), 2);
  EXPECT_EQ(half(Long::from_raw(-3)).raw(), -1);
  EXPECT_EQ(half(Long::largest()).raw(), 1 << 30);
}

TEST(FixedScalar, OverflowsByPolicy) {
  EXPECT_EQ(abs(Long::lowest()), Long::largest());
  EXPECT_EQ(twice(Long::lowest()), Long::lowest());
  EXPECT_EQ(scale_by_power_of_two(Long::from_raw(1), 31), Long::largest());
  EXPECT_EQ(scale_by_power_of_two(Long::from_raw(-1), 31), Long::lowest());
  EXPECT_EQ(scale_by_power_of_two(Long::from_raw(-1), 1000000), Long::lowest());
  EXPECT_EQ(scale_by_power_of_two(Long(), 1000000), Long());
}

TEST(FixedScalar, ScalesDownToNothingByRounding) {
  EXPECT_EQ(scale_by_power_of_two(Long::largest(), -31).raw(), 1);
  EXPECT_EQ(scale_by_power_of_two(Long::largest(), -32).raw(), 0);
  EXPECT_EQ(scale_by_power_of_two(Long::lowest(), -31).raw(), -1);
  EXPECT_EQ(scale_by_power_of_two(Long::lowest(), -32).raw(), 0);
  EXPECT_EQ(scale_by_power_of_two(Long::lowest(), std::numeric_limits<int>::min()).raw(), 0);
}

TEST(FixedScalar, SplitOfAValueAboveOneRoundsIntoTheNextBinade) {
  const auto whole = split(Mixed::from_real(12.0));
  EXPECT_EQ(whole.mantissa.to_real(), 0.75);
  EXPECT_EQ(whole.exponent, 4);
  const auto rounded = split(Mixed::from_raw((1 << 20) - 1));
  EXPECT_EQ(rounded.mantissa.to_real(), 0.5);
  EXPECT_EQ(rounded.exponent, 5);
}

template <class Float>
class FloatScalar : public testing::Test {};

using Formats = testing::Types<float, double>;
TYPED_TEST_SUITE(FloatScalar, Formats, );

TYPED_TEST(FloatScalar, SplitAndScaleReachBothEndsOfTheFormat) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam x : {Limits::denorm_min(), 5 * Limits::denorm_min(), Limits::min(),
                            std::nextafter(Limits::min(), TypeParam{0}), Limits::max()}) {
    int exponent = 0;
    const TypeParam mantissa = std::frexp(x, &exponent);
    const auto parts = split(x);
    EXPECT_EQ(parts.mantissa, mantissa);
    EXPECT_EQ(parts.exponent, exponent);
    EXPECT_EQ(scale_by_power_of_two(parts.mantissa, parts.exponent), x);
  }
  EXPECT_EQ(split(Limits::infinity()).mantissa, Limits::infinity());
  EXPECT_TRUE(std::isnan(split(Limits::quiet_NaN()).mantissa));
}

TYPED_TEST(FloatScalar, ScalingRoundsOnce) {
  using Limits = std::numeric_limits<TypeParam>;
  const TypeParam third = TypeParam{4} / TypeParam{3};
  for (const TypeParam x : {third, -third, TypeParam{1}, Limits::max(), Limits::min(),
                            Limits::denorm_min(), 3 * Limits::denorm_min()}) {
    for (int n = -2300; n <= 2300; ++n) {
      ASSERT_EQ(scale_by_power_of_two(x, n), std::ldexp(x, n)) << x << " * 2^" << n;
    }
  }
}

TYPED_TEST(FloatScalar, IsFiniteKnowsTheOthers) {
  using Limits = std::numeric_limits<TypeParam>;
  EXPECT_FALSE(is_finite(Limits::infinity()));
  EXPECT_FALSE(is_finite(-Limits::infinity()));
  EXPECT_FALSE(is_finite(Limits::quiet_NaN()));
  EXPECT_FALSE(is_finite(-Limits::quiet_NaN()));
  EXPECT_TRUE(is_finite(Limits::max()));
  EXPECT_TRUE(is_finite(Limits::lowest()));
  EXPECT_TRUE(is_finite(-Limits::denorm_min()));
}

TYPED_TEST(FloatScalar, CodesStopAtTheEndsOfTheConverter) {
  using Limits = std::numeric_limits<TypeParam>;
  using Code = std::numeric_limits<std::int32_t>;
  EXPECT_EQ(to_code(TypeParam{1}), Code::max());
  EXPECT_EQ(to_code(Limits::infinity()), Code::max());
  EXPECT_EQ(to_code(TypeParam{-1}), Code::min());
  EXPECT_EQ(to_code(-Limits::infinity()), Code::min());
  EXPECT_EQ(to_code(Limits::quiet_NaN()), 0);
  EXPECT_EQ(to_code(static_cast<TypeParam>(0x1p-32)), 1);
  EXPECT_EQ(to_code(static_cast<TypeParam>(-0x1p-32)), 0);
  EXPECT_EQ(to_code(static_cast<TypeParam>(-0x3p-32)), -1);
  EXPECT_EQ(to_code(std::nextafter(TypeParam{1}, TypeParam{0})),
            sizeof(TypeParam) == 4 ? Code::max() - 127 : Code::max());
}

TEST(DoubleCodes, LieNextToTheEnds) {
  EXPECT_EQ(to_code(2147483647.25 * 0x1p-31), 2147483647);
  EXPECT_EQ(to_code(2147483646.5 * 0x1p-31), 2147483647);
  EXPECT_EQ(to_code(-2147483648.25 * 0x1p-31), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(to_code(-2147483647.75 * 0x1p-31), std::numeric_limits<std::int32_t>::min());
}

TYPED_TEST(FloatScalar, SignOfBothZerosAndOfWhatIsNoNumberIsNone) {
  EXPECT_EQ(sign(TypeParam(-2.5)), TypeParam(-1));
  EXPECT_EQ(sign(TypeParam(0.25)), TypeParam(1));
  EXPECT_EQ(sign(TypeParam(-0.0)), TypeParam(0));
  EXPECT_EQ(sign(std::numeric_limits<TypeParam>::quiet_NaN()), TypeParam(0));
}

}  // namespace
}  // namespace sonoglide::numeric::scalar_test
