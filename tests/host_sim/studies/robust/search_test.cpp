#include "host_sim/studies/robust/study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace sonoglide::robust::search_test {
namespace {

/// Part of a step that a notch of three taps leaves as ripple when the natural mode turns by
/// `theta` in a carrier period instead of `believed`: |cos t - cos tn| / (1 - cos tn).
double residual(double theta, double nominal) {
  return std::abs(std::cos(theta) - std::cos(nominal)) / (1.0 - std::cos(nominal));
}

/// Of Table 1: sqrt(133e6 N/m / 0.02 kg) / 60 kHz.
const double nominal = std::sqrt(133e6 / 0.02) / 60e3;

/// Stiffness, mass and carrier frequency, each within 4 %, from the three parts of a cube.
double residual_at(const Place& place) {
  const auto factor = [](double part) { return 0.96 + 0.08 * part; };
  const double mass = place.size() > 1 ? factor(place[1]) : 1.0;
  const double frequency = place.size() > 2 ? factor(place[2]) : 1.0;
  return residual(nominal * std::sqrt(factor(place[0]) / mass) / frequency, nominal);
}

/// At the corner of a soft spring, a heavy mass and a fast carrier.
double worst_residual(std::size_t keys) {
  const Place corner = {0.0, 1.0, 1.0};
  return residual_at(Place(corner.begin(), corner.begin() + static_cast<std::ptrdiff_t>(keys)));
}

TEST(ResidualTest, IsThatOfTable1) {
  EXPECT_NEAR(nominal, 1.359125536, 1e-9);
  EXPECT_NEAR(worst_residual(1), 0.033883085, 1e-9);
  EXPECT_NEAR(residual_at({1.0}), 0.033406722, 1e-9);
}

/// The runs until a value is within 1e-3 of the worst; 0: never.
struct Found {
  std::size_t runs = 0;
  std::size_t all = 0;
  double highest = 0.0;
};

Found climb_from(const Place& start, std::size_t runs) {
  Found found;
  const double enough = (1.0 - 1e-3) * worst_residual(start.size());
  climb(start, runs, [&](std::size_t run, const Place& place) {
    EXPECT_EQ(run, found.all++);
    for (const double coordinate : place) {
      EXPECT_TRUE(coordinate >= 0.0 && coordinate <= 1.0);
    }
    const double value = residual_at(place);
    found.highest = std::max(found.highest, value);
    found.runs = found.runs == 0 && value >= enough ? run + 1 : found.runs;
    return value;
  });
  return found;
}

/// Random plants until one of them is within 1e-3 of the worst; at most `most`.
std::size_t random_runs(std::size_t keys, std::size_t most, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform;
  const double enough = (1.0 - 1e-3) * worst_residual(keys);
  for (std::size_t run = 1; run < most; ++run) {
    Place place;
    for (std::size_t i = 0; i < keys; ++i) {
      place.push_back(uniform(generator));
    }
    if (residual_at(place) >= enough) {
      return run;
    }
  }
  return most;
}

TEST(ClimbTest, FindsTheWorstCornerInATenthOfTheRunsOfRandomSampling) {
  for (std::size_t keys = 1; keys <= 3; ++keys) {
    const std::vector<Place> starts = {{0.35}, {0.35, 0.6}, {0.35, 0.6, 0.7}};
    const Found found = climb_from(starts[keys - 1], 200);
    std::size_t random = 0;
    for (std::uint64_t seed = 1; seed <= 9; ++seed) {
      random += random_runs(keys, 100000, seed);
    }
    EXPECT_GT(found.runs, 0U) << keys;
    EXPECT_LT(10 * found.runs, random / 9) << keys;
    EXPECT_NEAR(found.highest / worst_residual(keys), 1.0, 1e-4) << keys;
  }
}

TEST(ClimbTest, MeetsAMaximumInside) {
  Place highest;
  double height = -1e9;
  std::size_t runs = 0;
  climb({0.1, 0.9}, 300, [&](std::size_t /*run*/, const Place& place) {
    const double x = place[0] - 0.3;
    const double y = place[1] - 0.6;
    const double value = 1.0 - x * x - 2.0 * y * y - x * y;
    if (value > height) {
      height = value;
      highest = place;
    }
    ++runs;
    return value;
  });
  EXPECT_NEAR(highest[0], 0.3, 1e-3);
  EXPECT_NEAR(highest[1], 0.6, 1e-3);
  EXPECT_LE(runs, 300U);
}

TEST(ClimbTest, KeepsToItsRunsAndEndsOnAPlain) {
  std::size_t runs = 0;
  climb({0.5, 0.5, 0.5}, 7, [&](std::size_t /*run*/, const Place& /*place*/) {
    ++runs;
    return 1.0;
  });
  EXPECT_LE(runs, 7U);
  EXPECT_GT(runs, 0U);
}

}  // namespace
}  // namespace sonoglide::robust::search_test
