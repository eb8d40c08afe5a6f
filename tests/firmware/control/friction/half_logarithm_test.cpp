#include "firmware/control/friction/half_logarithm.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scalars.hpp"

namespace sonoglide::control::half_logarithm_test {
namespace {

template <class Scalar>
class HalfLogarithmTest : public testing::Test {};
TYPED_TEST_SUITE(HalfLogarithmTest, Scalars);

template <class Scalar>
double real_of(const numeric::Floating<Scalar>& x) {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return std::ldexp(numeric::to_real(x.mantissa), x.exponent);
  } else {
    return numeric::to_real(x);
  }
}

/// Of a/b, a = quotient b.
template <class Scalar>
void expect_logarithm(double b, double quotient, double least_share) {
  const double exact = 0.5 * std::log(quotient);
  const double found = numeric::to_real(half_log(scaled<Scalar>(quotient * b), scaled<Scalar>(b)));
  const double rounding = 1e-6;  // the numbers themselves round, b is down to 2^-9
  EXPECT_LE(std::abs(found), std::abs(exact) + rounding) << b << " " << quotient;
  EXPECT_GE(std::abs(found), least_share * std::abs(exact) - rounding) << b << " " << quotient;
  EXPECT_EQ(found < 0.0, quotient < 1.0) << b << " " << quotient;
}

TYPED_TEST(HalfLogarithmTest, IsTooSmallByLittle) {
  for (double b = 0x1p-9; b < 0.499; b *= 1.37) {
    for (double quotient = 1.01; quotient <= 2.0; quotient += 0.0437) {
      const double least_share = quotient <= 1.6 ? 1.0 - 0.0006 : 1.0 - 0.003;
      expect_logarithm<TypeParam>(b, quotient, least_share);
      expect_logarithm<TypeParam>(b, 1.0 / quotient, least_share);
    }
  }
}

TYPED_TEST(HalfLogarithmTest, IsLimited) {
  const double most = 0.6 + 0.6 * 0.6 * 0.6 / 3.0;
  EXPECT_NEAR(numeric::to_real(half_log(scaled<TypeParam>(0.9), TypeParam{})), most, 1e-6);
  EXPECT_NEAR(numeric::to_real(half_log(TypeParam{}, scaled<TypeParam>(0.9))), -most, 1e-6);
  EXPECT_EQ(numeric::to_real(half_log(TypeParam{}, TypeParam{})), 0.0);
}

TYPED_TEST(HalfLogarithmTest, TheExponentialIsWithinOnePercent) {
  for (double x = -0.5; x <= 0.5; x += 0.0123) {
    const double relative =
        real_of<TypeParam>(exponential_of_twice(scaled<TypeParam>(x))) / std::exp(2.0 * x) - 1.0;
    EXPECT_LE(std::abs(relative), std::abs(x) <= 0.25 ? 0.0003 : 0.01) << x;
  }
}

TYPED_TEST(HalfLogarithmTest, TheInverseIsOne) {
  for (double x = 0x1p-12; x < 1.0; x *= 1.31) {
    EXPECT_NEAR(real_of<TypeParam>(inverse_of(scaled<TypeParam>(x))) *
                    numeric::to_real(scaled<TypeParam>(x)),
                1.0, 1e-6)
        << x;
  }
}

}  // namespace
}  // namespace sonoglide::control::half_logarithm_test
