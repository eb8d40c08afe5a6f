/// Against the C library's functions in extended precision.
#include "host_sim/studies/sweep/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace sonoglide::sweep::decades_test {
namespace {

TEST(DecadesTest, WholePowersAreExact) {
  for (int n = -307; n <= 308; ++n) {
    const double power = std::strtod(("1e" + std::to_string(n)).c_str(), nullptr);
    EXPECT_EQ(power_of_ten(n), power);
    EXPECT_EQ(logarithm_to_ten(power), n);
  }
}

TEST(DecadesTest, AreAsGoodAsTheySay) {
  for (int i = 1; i < 20000; ++i) {
    const double x = -300.0 + 600.0 * std::fmod(i * 0.61803398874989485, 1.0);
    const double power = power_of_ten(x);
    const auto exact_power = static_cast<double>(std::pow(10.0L, static_cast<long double>(x)));
    const auto exact_logarithm = static_cast<double>(std::log10(static_cast<long double>(power)));
    EXPECT_LE(std::abs(power / exact_power - 1.0), 1e-15) << x;
    EXPECT_LE(std::abs(logarithm_to_ten(power) - exact_logarithm), 4e-16 * (1.0 + std::abs(x)))
        << power;
  }
}

TEST(DecadesTest, BeyondTheRangeTheyAreNothingOrInfinite) {
  EXPECT_EQ(power_of_ten(-400.0), 0.0);
  EXPECT_EQ(power_of_ten(400.0), HUGE_VAL);
}

}  // namespace
}  // namespace sonoglide::sweep::decades_test
