/// Polynomials against their values in closed form.
#include "firmware/numeric/power_series.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace sonoglide::numeric::power_series_test {
namespace {

/// 3 - 2 x + x^2 + 4 x^3 + 5 x^4 - x^5.
constexpr std::array<double, 6> p{3.0, -2.0, 1.0, 4.0, 5.0, -1.0};

TEST(PowerSeries, ReciprocalsAreTheNearest) {
  for (std::size_t n = 1; n < 64; ++n) {
    EXPECT_EQ(reciprocal<double>(n), 1.0 / static_cast<double>(n));
  }
}

TEST(PowerSeries, PowersAreProducts) {
  EXPECT_EQ(power<0>(3.0), 1.0);
  EXPECT_EQ(power<1>(3.0), 3.0);
  EXPECT_EQ(power<7>(3.0), 2187.0);
  EXPECT_EQ(power<8>(-2.0F), 256.0F);
}

TEST(PowerSeries, ValuesAreTheSums) {
  EXPECT_EQ(evaluate(p, 2.0), 83.0);
  EXPECT_EQ((evaluate_from<2>(p, 2.0)), 21.0);
  EXPECT_EQ(evaluate(std::array<double, 1>{3.0}, 2.0), 3.0);
}

TEST(PowerSeries, DerivativesAreOverTheFactorialOfTheirDegree) {
  EXPECT_EQ(derivative<1>(p), (std::array<double, 5>{-2.0, 2.0, 12.0, 20.0, -5.0}));
  EXPECT_EQ(derivative<3>(p), (std::array<double, 3>{4.0, 20.0, -10.0}));
}

TEST(PowerSeries, IntegralsAreThoseOfThePowers) {
  // Of x^n: x^(n+1)/(n+1), and of x^(n+1): x^(n+2)/(n+2).
  const double x = 2.0;
  EXPECT_NEAR(integrate(p, x), 6.0 - 4.0 + 8.0 / 3.0 + 16.0 + 32.0 - 64.0 / 6.0, 1e-13);
  EXPECT_NEAR(first_moment(p, x), 6.0 - 16.0 / 3.0 + 4.0 + 25.6 + 160.0 / 3.0 - 128.0 / 7.0, 1e-13);
}

}  // namespace
}  // namespace sonoglide::numeric::power_series_test
