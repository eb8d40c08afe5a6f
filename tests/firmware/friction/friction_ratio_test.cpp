#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::friction::friction_ratio_test {
namespace {

using tests::pi;

TEST(CoulombFrictionRatio, MatchesPublishedValues) {
  EXPECT_NEAR(coulomb_friction_ratio(0.1), 0.06377, 5e-6);
  EXPECT_NEAR(coulomb_friction_ratio(0.3), 0.19397, 5e-6);
  EXPECT_NEAR(coulomb_friction_ratio(0.5), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(coulomb_friction_ratio(0.8), 0.59033, 5e-6);
  EXPECT_NEAR(coulomb_friction_ratio(0.95), 0.79783, 5e-6);
  EXPECT_EQ(coulomb_friction_ratio(1.0), 1.0);
  EXPECT_EQ(coulomb_friction_ratio(-7.0), 1.0);
}

TEST(DahlFrictionRatio, MatchesPublishedValues) {
  struct Row {
    double velocity_ratio;
    double ratio[5];
  };
  const double dahl_number[5] = {1e-4, 0.404519756998724, 2.023, 10.0, 100.0};
  const Row rows[] = {{0.1, {.15630, .14875, .08814, .0661, .0640}},
                      {0.5, {.69638, .67494, .48927, .3502, .3348}},
                      {0.9, {.97924, .97585, .94541, .8570, .7246}}};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_NEAR(dahl_friction_ratio(row.velocity_ratio, dahl_number[i]), row.ratio[i], 5e-5)
          << row.velocity_ratio << ' ' << dahl_number[i];
    }
  }
  EXPECT_NEAR(dahl_friction_ratio(0.5, 0.404519756998724), 0.674948666956629, 1e-14);
}

TEST(DahlFrictionRatio, HasTheElasticLimit) {
  for (double r = 0.01; r < 1.0; r += 0.01) {
    const double limit = pi * r / (2.0 * (std::sqrt(1.0 - r * r) + r * std::asin(r)));
    EXPECT_NEAR(dahl_friction_ratio(r, 1e-7), limit, 1e-7) << r;
  }
}

TEST(DahlFrictionRatio, HasTheCoulombLimit) {
  for (double r = 0.01; r < 0.99; r += 0.01) {
    EXPECT_NEAR(dahl_friction_ratio(r, 1e12), coulomb_friction_ratio(r), 1e-5) << r;
  }
}

TEST(DahlFrictionRatio, RisesWithVelocityRatioAndFallsWithDahlNumber) {
  for (double dahl_number = 1e-4; dahl_number < 1e7; dahl_number *= 3.7) {
    double previous = 0.0;
    for (double r = 0.005; r < 1.0; r += 0.005) {
      const double ratio = dahl_friction_ratio(r, dahl_number);
      EXPECT_GT(ratio, previous) << r << ' ' << dahl_number;
      EXPECT_GE(ratio, coulomb_friction_ratio(r) - 1e-12) << r << ' ' << dahl_number;
      EXPECT_GE(ratio, dahl_friction_ratio(r, 1.01 * dahl_number) - 1e-12);
      EXPECT_EQ(ratio, dahl_friction_ratio(-r, dahl_number));
      previous = ratio;
    }
    EXPECT_EQ(dahl_friction_ratio(1.0, dahl_number), 1.0);
    EXPECT_EQ(dahl_friction_ratio(2.0, dahl_number), 1.0);
    EXPECT_NEAR(dahl_friction_ratio(0.0, dahl_number), 0.0, 1e-13);
  }
}

}  // namespace
}  // namespace sonoglide::friction::friction_ratio_test
