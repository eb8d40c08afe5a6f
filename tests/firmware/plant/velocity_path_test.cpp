#include "firmware/plant/velocity_path.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/firmware/plant/runs/quartic_path.hpp"

namespace sonoglide::plant::velocity_path_test {
namespace {

TEST(VelocityPath, IsTheQuarticThroughItsEnds) {
  const std::array<double, 5> p = {0.3, -1.0, 0.7, 2.0, -1.6};
  const VelocityPath<double> path = path_through(p, 0.4);
  for (const double x : {0.0, 0.2, 0.5, 1.0}) {
    EXPECT_NEAR(path.velocity(x), (((p[4] * x + p[3]) * x + p[2]) * x + p[1]) * x + p[0], 1e-14);
    EXPECT_NEAR(path.displacement(x),
                0.4 * x * ((((p[4] / 5 * x + p[3] / 4) * x + p[2] / 3) * x + p[1] / 2) * x + p[0]),
                1e-14);
  }
  EXPECT_NEAR(path.displacement(), path.displacement(1.0), 1e-15);
}

/// (x - a)(x - b)(x - c)(x - d) reverses where its roots are, those in the step.
RC_GTEST_PROP(VelocityPath, FindsEveryReversal, ()) {
  std::array<double, 5> p = {1.0, 0.0, 0.0, 0.0, 0.0};
  std::vector<double> inside;
  double root = -0.50005;
  for (int n = 0; n < 4; ++n) {
    root += *rc::gen::inRange(1, 800) * 1e-3;
    for (std::size_t i = 4; i > 0; --i) {
      p[i] = p[i - 1] - root * p[i];
    }
    p[0] *= -root;
    if (root > 0.0 && root < 1.0) {
      inside.push_back(root);
    }
  }
  const Reversals<double> found = path_through(p, 1.0).reversals();
  RC_ASSERT(found.count == inside.size());
  for (std::size_t i = 0; i < found.count; ++i) {
    RC_ASSERT(std::abs(found.at[i] - inside[i]) < 1e-7);
  }
}

TEST(VelocityPath, ARootWhereThePieceIsHalvedIsNotLost) {
  // (x - 1/4)(x - 1/2)(x - 3/4)
  const Reversals<double> found = path_through({-0.09375, 0.6875, -1.5, 1.0, 0.0}, 1.0).reversals();
  ASSERT_EQ(found.count, 3U);
  EXPECT_NEAR(found.at[0], 0.25, 1e-9);
  EXPECT_NEAR(found.at[1], 0.50, 1e-9);
  EXPECT_NEAR(found.at[2], 0.75, 1e-9);
}

TEST(VelocityPath, FromRestItGoesWhereItGoes) {
  EXPECT_EQ(path_through({0.0, 0.0, -1.0, 0.0, 0.0}, 1.0).first_direction(), -1.0);
  EXPECT_EQ(path_through({0.0, 0.0, 0.0, 0.0, 0.0}, 1.0).first_direction(), 0.0);
  const Reversals<double> found = path_through({0.0, 1.0, -2.0, 0.0, 0.0}, 1.0).reversals();
  ASSERT_EQ(found.count, 1U);
  EXPECT_NEAR(found.at[0], 0.5, 1e-12);
}

}  // namespace
}  // namespace sonoglide::plant::velocity_path_test
