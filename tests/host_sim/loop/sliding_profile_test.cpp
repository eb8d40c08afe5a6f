#include "host_sim/loop/plant/sliding_profile.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace sonoglide::loop::sliding_profile_test {
namespace {

using Times = std::vector<double>;

TEST(SlidingProfileTest, OnePointIsAConstant) {
  const SlidingProfile profile({{{0.0, -0.02}}});
  for (const double time_s : {-1.0, 0.0, 1e-9, 5.0}) {
    EXPECT_EQ(profile.velocity_m_per_s(time_s), -0.02);
  }
}

TEST(SlidingProfileTest, IsConstantWhereEveryPointHasOneVelocity) {
  EXPECT_TRUE(SlidingProfile({{{0.0, 0.02}}}).is_constant());
  EXPECT_TRUE(SlidingProfile({{{0.0, 0.02}, {1.0, 0.02}, {3.0, 0.02}}}).is_constant());
  EXPECT_FALSE(SlidingProfile({{{0.0, 0.02}, {1.0, 0.02}, {3.0, 0.03}}}).is_constant());
}

TEST(SlidingProfileTest, IsLinearBetweenPointsAndConstantOutside) {
  const SlidingProfile profile({{{1.0, 0.5}, {2.0, 1.0}, {4.0, -3.0}}});
  EXPECT_EQ(profile.velocity_m_per_s(0.0), 0.5);
  EXPECT_EQ(profile.velocity_m_per_s(1.0), 0.5);
  EXPECT_EQ(profile.velocity_m_per_s(1.5), 0.75);
  EXPECT_EQ(profile.velocity_m_per_s(2.0), 1.0);
  EXPECT_EQ(profile.velocity_m_per_s(2.5), 0.0);
  EXPECT_EQ(profile.velocity_m_per_s(3.0), -1.0);
  EXPECT_EQ(profile.velocity_m_per_s(4.0), -3.0);
  EXPECT_EQ(profile.velocity_m_per_s(9.0), -3.0);
}

TEST(SlidingProfileTest, CutsAtItsPointsAndWhereTheVelocityChangesSign) {
  EXPECT_EQ(SlidingProfile({{{1.0, 0.5}, {2.0, 1.0}, {4.0, -3.0}}}).cuts_s(),
            (Times{1.0, 2.0, 2.5, 4.0}));
  EXPECT_EQ(SlidingProfile({{{0.0, 0.02}}}).cuts_s(), Times{0.0});
}

TEST(SlidingProfileTest, CutsOnceWhereTheVelocityTouchesZeroAtAPoint) {
  EXPECT_EQ(SlidingProfile({{{0.0, 1.0}, {1.0, 0.0}, {2.0, 0.0}, {3.0, -1.0}}}).cuts_s(),
            (Times{0.0, 1.0, 2.0, 3.0}));
}

TEST(SlidingProfileTest, CrossesZeroAtItsCuts) {
  const SlidingProfile profile({{{0.0, 0.3}, {7e-3, -0.1}, {11e-3, 0.9}}});
  const Times cuts = profile.cuts_s();
  ASSERT_EQ(cuts.size(), 5U);
  EXPECT_NEAR(profile.velocity_m_per_s(cuts[1]), 0.0, 1e-16);
  EXPECT_NEAR(profile.velocity_m_per_s(cuts[3]), 0.0, 1e-16);
  EXPECT_NEAR(cuts[1], 5.25e-3, 1e-17);
  EXPECT_NEAR(cuts[3], 7.4e-3, 1e-17);
}

}  // namespace
}  // namespace sonoglide::loop::sliding_profile_test
