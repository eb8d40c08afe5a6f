#include "host_sim/studies/robust/spread.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <map>

namespace sonoglide::robust::spread_test {
namespace {

scene::Tolerance half_width(double nominal, double amount) {
  return {"a.b",
          scene::Spread::half_width,
          amount,
          nominal,
          nominal - amount * std::abs(nominal),
          nominal + amount * std::abs(nominal)};
}

scene::Tolerance normal(double nominal, double amount, double lowest, double highest) {
  return {"a.b", scene::Spread::normal, amount, nominal, lowest, highest};
}

scene::Tolerance integers(double lowest, double highest) {
  return {"a.b", scene::Spread::range, 0.0, lowest, lowest, highest, true};
}

double unit() {
  return (*rc::gen::inRange<int>(0, 1 << 20) + 0.5) / (1 << 20);
}

TEST(SpreadTest, UniformOnesAreLinearAndKeepTheirEnds) {
  EXPECT_TRUE(rc::check([] {
    const scene::Tolerance tolerance = half_width(-200.0, 0.5);
    const double u = unit();
    RC_ASSERT(std::abs(quantile(tolerance, u) - (-300.0 + 200.0 * u)) < 1e-10);
    RC_ASSERT(std::abs(search_part(tolerance, quantile(tolerance, u)) - u) < 1e-12);
  }));
  const scene::Tolerance tolerance = half_width(133e6, 0.04);
  EXPECT_EQ(search_value(tolerance, 0.0), tolerance.lowest);
  EXPECT_EQ(search_value(tolerance, 1.0), tolerance.highest);
}

// Quantiles of the normal distribution: Abramowitz and Stegun, tables 26.1 and 26.5.
TEST(SpreadTest, NormalOnesHaveTheQuantilesOfTheTables) {
  const scene::Tolerance tolerance = normal(10.0, 0.1, -1e9, 1e9);
  EXPECT_NEAR(quantile(tolerance, 0.5), 10.0, 1e-12);
  EXPECT_NEAR(quantile(tolerance, 0.975), 11.959963985, 1e-9);
  EXPECT_NEAR(quantile(tolerance, 0.01), 10.0 - 2.326347874, 1e-9);
  EXPECT_EQ(search_interval(tolerance).lowest, 7.0);
  EXPECT_EQ(search_interval(tolerance).highest, 13.0);
}

/// Cut off at the mean: the half-normal distribution, whose median is 0.674489750 deviations.
TEST(SpreadTest, NormalOnesAreCutOffAtTheRangeOfTheKey) {
  const scene::Tolerance half = normal(1.0, 1.0, 1.0, 100.0);
  EXPECT_NEAR(quantile(half, 0.5), 1.674489750, 1e-9);
  const scene::Tolerance wide = normal(0.1, 5.0, 0.0, 100.0);
  EXPECT_TRUE(rc::check([&] {
    const double value = quantile(wide, unit());
    RC_ASSERT(value >= 0.0 && value <= 100.0);
  }));
  EXPECT_EQ(search_interval(wide).lowest, 0.0);
}

TEST(SpreadTest, IntegersAreEquallyLikely) {
  const scene::Tolerance tolerance = integers(1.0, 3.0);
  std::map<double, int> count;
  for (int i = 0; i < 300; ++i) {
    ++count[quantile(tolerance, (i + 0.5) / 300.0)];
  }
  EXPECT_EQ(count, (std::map<double, int>{{1.0, 100}, {2.0, 100}, {3.0, 100}}));
  EXPECT_EQ(search_value(tolerance, 1.0), 3.0);
  for (const double value : {1.0, 2.0, 3.0}) {
    EXPECT_EQ(search_value(tolerance, search_part(tolerance, value)), value);
  }
}

}  // namespace
}  // namespace sonoglide::robust::spread_test
