#include "host_sim/studies/robust/spread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

namespace sonoglide::robust::sobol_test {
namespace {

/// Parts of [0, 1) of the coordinate with 2^bits parts.
std::size_t part(double coordinate, int bits) {
  return static_cast<std::size_t>(std::ldexp(coordinate, bits));
}

/// Whether every box of 2^-a by 2^-b with a + b = m - t holds 2^t of the first 2^m points.
bool is_net(const std::vector<double>& points, std::size_t dimensions, std::size_t first,
            std::size_t second, int m, int t) {
  for (int a = 0; a <= m - t; ++a) {
    const int b = m - t - a;
    std::vector<int> count(std::size_t{1} << (m - t), 0);
    for (std::size_t i = 0; i < std::size_t{1} << m; ++i) {
      const double* point = points.data() + i * dimensions;
      ++count[(part(point[first], a) << b) | part(point[second], b)];
    }
    if (std::any_of(count.begin(), count.end(), [&](int each) { return each != 1 << t; })) {
      return false;
    }
  }
  return true;
}

TEST(SobolTest, TheFirstTwoCoordinatesAreANetForEverySeed) {
  for (const std::uint64_t seed : {0U, 1U, 2U, 12345U}) {
    for (int m = 0; m <= 10; ++m) {
      const auto points = scrambled_sobol(5, std::size_t{1} << m, seed);
      EXPECT_TRUE(is_net(points, 5, 0, 1, m, 0)) << seed << " " << m;
    }
  }
}

TEST(SobolTest, EveryCoordinateFallsOnceIntoEachPart) {
  constexpr std::size_t dimensions = 40;
  constexpr int m = 9;
  const auto points = scrambled_sobol(dimensions, std::size_t{1} << m, 3);
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::set<std::size_t> parts;
    for (std::size_t i = 0; i < std::size_t{1} << m; ++i) {
      parts.insert(part(points[i * dimensions + d], m));
    }
    EXPECT_EQ(parts.size(), std::size_t{1} << m) << d;
  }
}

/// Discrepancies of coordinates further on are larger: their pairs are nets of a higher t.
TEST(SobolTest, PairsFurtherOnAreNetsToo) {
  const auto points = scrambled_sobol(12, 1024, 9);
  for (std::size_t first = 0; first < 12; ++first) {
    for (std::size_t second = first + 1; second < 12; ++second) {
      EXPECT_TRUE(is_net(points, 12, first, second, 10, 5)) << first << " " << second;
    }
  }
}

TEST(SobolTest, CoordinatesAreInsideTheCubeAndFollowTheSeed) {
  const auto one = scrambled_sobol(3, 1000, 1);
  const auto other = scrambled_sobol(3, 1000, 2);
  EXPECT_EQ(one, scrambled_sobol(3, 1000, 1));
  std::size_t equal = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_GT(one[i], 0.0);
    EXPECT_LT(one[i], 1.0);
    equal += one[i] == other[i] ? 1 : 0;
  }
  EXPECT_EQ(equal, 0U);
  // A longer sequence begins with a shorter one.
  const auto more = scrambled_sobol(3, 2000, 1);
  EXPECT_TRUE(std::equal(one.begin(), one.end(), more.begin()));
}

/// Each point by itself is uniform over the seeds: mean 1/2, variance 1/12.
TEST(SobolTest, OverTheSeedsAPointIsUniform) {
  constexpr int seeds = 4000;
  double sum = 0.0;
  double square = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    const double x = scrambled_sobol(2, 3, static_cast<std::uint64_t>(seed))[5] - 0.5;
    sum += x;
    square += x * x;
  }
  EXPECT_NEAR(sum / seeds, 0.0, 4.0 * std::sqrt(1.0 / 12.0 / seeds));
  EXPECT_NEAR(square / seeds, 1.0 / 12.0, 4.0 * std::sqrt(1.0 / 180.0 / seeds));
}

/// The mean of a smooth function converges far faster than 1/sqrt(n): of random points 5 in 100
/// would be so good here by chance, not four seeds of four.
TEST(SobolTest, IntegratesASmoothFunction) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    constexpr std::size_t count = 4096;
    const auto points = scrambled_sobol(4, count, seed);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      double product = 1.0;
      for (std::size_t d = 0; d < 4; ++d) {
        product *= 1.0 + 0.5 * (points[4 * i + d] - 0.5);
      }
      sum += product;
    }
    const double random_deviation = 0.29 / std::sqrt(static_cast<double>(count));
    EXPECT_NEAR(sum / count, 1.0, random_deviation / 15.0) << seed;
  }
}

}  // namespace
}  // namespace sonoglide::robust::sobol_test
