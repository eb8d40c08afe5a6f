#include "host_sim/studies/robust/report.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <vector>

namespace sonoglide::robust::statistics_test {
namespace {

constexpr double never = std::numeric_limits<double>::quiet_NaN();

// The rule of three and its kin: 1 - 0.05^(1/n) and so on.
TEST(FailureProbabilityTest, WithoutFailureItIsTheRootOfTheDoubt) {
  EXPECT_LT(failure_probability_upper(0, 59, 0.95), 0.05);
  EXPECT_GT(failure_probability_upper(0, 58, 0.95), 0.05);
  EXPECT_LT(failure_probability_upper(0, 459, 0.99), 0.01);
  EXPECT_GT(failure_probability_upper(0, 458, 0.99), 0.01);
  EXPECT_LT(failure_probability_upper(0, 6905, 0.999), 0.001);
  EXPECT_GT(failure_probability_upper(0, 6904, 0.999), 0.001);
  for (const std::size_t n : {1U, 7U, 1000U, 1000000U}) {
    EXPECT_NEAR(failure_probability_upper(0, n, 0.95) /
                    -std::expm1(std::log(0.05) / static_cast<double>(n)),
                1.0, 1e-12);
  }
}

/// Probability of so few failures or fewer.
double binomial_tail(std::size_t failures, std::size_t runs, double p) {
  double sum = 0.0;
  const auto n = static_cast<double>(runs);
  for (std::size_t i = 0; i <= failures; ++i) {
    const auto k = static_cast<double>(i);
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                    k * std::log(p) + (n - k) * std::log1p(-p));
  }
  return sum;
}

TEST(FailureProbabilityTest, SolvesTheEquationOfItsDefinition) {
  EXPECT_TRUE(rc::check([] {
    const auto runs = *rc::gen::inRange<std::size_t>(2, 3000);
    const auto failures = *rc::gen::inRange<std::size_t>(0, runs);
    const double upper = failure_probability_upper(failures, runs, 0.95);
    RC_ASSERT(std::abs(binomial_tail(failures, runs, upper) - 0.05) < 1e-8);
  }));
  EXPECT_EQ(failure_probability_upper(5, 5, 0.95), 1.0);
}

TEST(QuantilesTest, AreByNearestRankAndNeverIsLast) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) {
    values.push_back(i);
  }
  const Quantiles all = quantiles(values);
  EXPECT_EQ(all.median, 50.0);
  EXPECT_EQ(all.p95, 95.0);
  EXPECT_EQ(all.p99, 99.0);
  EXPECT_EQ(all.worst, 100.0);
  values[0] = never;
  values[1] = never;
  const Quantiles some = quantiles(values);
  EXPECT_EQ(some.p95, 95.0);
  EXPECT_TRUE(std::isnan(some.p99));
  EXPECT_TRUE(std::isnan(some.worst));
  EXPECT_EQ(quantiles({7.0}).median, 7.0);
}

TEST(RankCorrelationTest, SeesAnyRiseAndFall) {
  std::vector<double> x;
  std::vector<double> rise;
  std::vector<double> fall;
  for (int i = 0; i < 50; ++i) {
    x.push_back(0.1 * i);
    rise.push_back(std::exp(0.3 * i));
    fall.push_back(i == 0 ? never : 1.0 / i);
  }
  EXPECT_DOUBLE_EQ(rank_correlation(Ranks(x), Ranks(rise)), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation(Ranks(x), Ranks(fall)), -1.0)
      << "never is more than any number";
  EXPECT_TRUE(std::isnan(rank_correlation(Ranks(x), Ranks(std::vector<double>(50, 1.0)))));
}

// Student's example of ties: ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4 give 9/sqrt(90).
TEST(RankCorrelationTest, SharesTheRanksOfTies) {
  EXPECT_NEAR(rank_correlation(Ranks({1, 2, 2, 3}), Ranks({1, 2, 3, 4})), 9.0 / std::sqrt(90.0),
              1e-15);
}

TEST(RankCorrelationTest, RoundingIsNoDifference) {
  EXPECT_TRUE(
      std::isnan(rank_correlation(Ranks({1, 2, 3}), Ranks({0.4, 0.4 + 1e-16, 0.4 - 1e-15}))));
  EXPECT_TRUE(is_one_value(-0.3, -0.3 + 1e-16));
  EXPECT_TRUE(is_one_value(0.0, 0.0));
  EXPECT_FALSE(is_one_value(0.0, 1e-20));
  EXPECT_FALSE(is_one_value(1.0, 1.0 + 1e-9));
}

TEST(MainEffectTest, SeesATurnThatTheCorrelationDoesNot) {
  std::vector<double> x;
  std::vector<double> z;
  std::vector<double> turn;
  constexpr int count = 1024;
  for (int i = 0; i < count; ++i) {
    x.push_back((i + 0.5) / count - 0.5);
    z.push_back(std::fmod(0.6180339887 * i, 1.0));
    turn.push_back(x.back() * x.back());
  }
  EXPECT_LT(std::abs(rank_correlation(Ranks(x), Ranks(turn))), 0.01);
  EXPECT_GT(main_effect(Ranks(x), Ranks(turn)), 0.95);
  EXPECT_LT(main_effect(Ranks(z), Ranks(turn)), 0.05);
  EXPECT_TRUE(std::isnan(main_effect(Ranks(x), Ranks(std::vector<double>(count, 2.0)))));
  EXPECT_TRUE(std::isnan(main_effect(Ranks({1.0, 2.0}), Ranks({1.0, 2.0}))));
}

/// Two keys with equal shares of a sum explain half of it each.
TEST(MainEffectTest, OfASumAreItsShares) {
  std::vector<double> x;
  std::vector<double> z;
  std::vector<double> sum;
  for (int i = 0; i < 4096; ++i) {
    x.push_back(std::fmod(0.754877666 * i, 1.0));
    z.push_back(std::fmod(0.569840291 * i, 1.0));
    sum.push_back(x.back() + z.back());
  }
  EXPECT_NEAR(main_effect(Ranks(x), Ranks(sum)), 0.5, 0.03);
  EXPECT_NEAR(main_effect(Ranks(z), Ranks(sum)), 0.5, 0.03);
}

}  // namespace
}  // namespace sonoglide::robust::statistics_test
