/// The controller around a contact on its steady map: it gets where it should, from either side.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "closed_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::closed_loop_test {
namespace {

template <class Scalar>
class ClosedLoopTest : public testing::Test {};
TYPED_TEST_SUITE(ClosedLoopTest, Scalars);

TYPED_TEST(ClosedLoopTest, FeedforwardAloneIsWithinItsTable) {
  Design design;
  design.gain = 0.0;
  for (const double speed : {0.05, 0.1, 0.3}) {
    for (const double target : {0.4, 0.6, 0.8, 0.95}) {
      ClosedLoop<ShapedParts<TypeParam>> loop(design);
      loop.set_target(target);
      loop.run(2 * design.spacing + 3, speed);
      EXPECT_NEAR(loop.ratio(), target, 0.002) << "speed " << speed;
    }
  }
}

TYPED_TEST(ClosedLoopTest, FeedbackTakesTheRestAway) {
  for (const double speed : {0.05, 0.1, 0.3}) {
    for (const double target : {0.4, 0.6, 0.8, 0.95}) {
      ClosedLoop<ShapedParts<TypeParam>> loop({});
      loop.set_target(target);
      loop.run(150, speed);
      EXPECT_NEAR(loop.ratio(), target, 1e-5) << "speed " << speed;
    }
  }
}

TYPED_TEST(ClosedLoopTest, FollowsTargetsUpAndDown) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  for (const double target : {0.4, 0.6, 0.2, 0.9, 1.0, 0.35}) {
    loop.set_target(target);
    loop.run(6);
    EXPECT_NEAR(loop.ratio(), target, 0.01);
    loop.run(100);
    EXPECT_NEAR(loop.ratio(), target, 1e-5);
  }
}

TYPED_TEST(ClosedLoopTest, FollowsWhereTheContactIsNotAsBelieved) {
  for (const double stiffness : {0.5, 2.0}) {
    ClosedLoop<ShapedParts<TypeParam>> loop({}, Contact{0.5, 1.0108 * stiffness});
    for (const double target : {0.4, 0.7}) {
      loop.set_target(target);
      loop.run(200);
      EXPECT_NEAR(loop.ratio(), target, 1e-4) << "contact stiffness times " << stiffness;
    }
  }
}

TYPED_TEST(ClosedLoopTest, SlidingTheOtherWayIsTheSame) {
  ClosedLoop<ShapedParts<TypeParam>> forward({});
  ClosedLoop<ShapedParts<TypeParam>> backward({});
  forward.set_target(0.45);
  backward.set_target(0.45);
  for (int i = 0; i < 200; ++i) {
    ASSERT_EQ(forward.step(0.1).amplitude, backward.step(-0.1).amplitude);
  }
}

TYPED_TEST(ClosedLoopTest, HoldsTheTargetAcrossAReversal) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.set_target(0.5);
  loop.run(100);
  double velocity = 0.1;
  int held = 0;
  while (velocity > -0.1) {
    velocity -= 0.0008;
    const auto& command = loop.step(velocity);
    ASSERT_EQ(command.fault, Fault::none);
    if (command.limit == Limit::none && std::abs(velocity) > 0.04) {
      ++held;
      EXPECT_NEAR(loop.ratio(), 0.5, 0.01) << "velocity " << velocity;
    }
  }
  EXPECT_GE(held, 140);  // of 150 on both sides of the reversal
  loop.run(100, velocity);
  EXPECT_NEAR(loop.ratio(), 0.5, 1e-5);
}

// The sensor still shows the friction of before, now against the sliding: no error to act upon.
TYPED_TEST(ClosedLoopTest, ASuddenReversalIsNoErrorWhileTheSensorLags) {
  for (const unsigned delay : {2U, 5U, 10U}) {
    Design design;
    design.gain = 0.03;
    design.hold_periods = static_cast<std::uint16_t>(delay + 5);
    design.stuck_periods = static_cast<std::uint16_t>(delay + 11);
    ClosedLoop<ShapedParts<TypeParam>> loop(design);
    loop.delay_sensor(delay);
    loop.set_target(0.5);
    loop.run(400);
    loop.run(2 * design.spacing + 2, -0.1);  // the step itself, foreseen too far, leaves the shaper
    for (int i = 0; i < 200; ++i) {
      ASSERT_EQ(loop.step(-0.1).fault, Fault::none) << "delay " << delay;
      ASSERT_NEAR(loop.ratio(), 0.5, 0.01) << "delay " << delay << " period " << i;
    }
  }
}

TYPED_TEST(ClosedLoopTest, TargetsAreLimitedToWhatRatiosCanBe) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.controller.set_target(scaled<TypeParam>(0.9));
  EXPECT_EQ(loop.step().amplitude, TypeParam{});
  loop.controller.set_target(scaled<TypeParam>(-0.9));
  EXPECT_EQ(loop.step().limit, Limit::actuator);
}

template <class Scalar>
class ClosedLoopFloatingTest : public testing::Test {};
TYPED_TEST_SUITE(ClosedLoopFloatingTest, FloatingScalars);

TYPED_TEST(ClosedLoopFloatingTest, ATargetThatIsNoNumberIsNotTaken) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  ClosedLoop<ShapedParts<TypeParam>> untold({});
  loop.set_target(0.4);
  untold.set_target(0.4);
  for (int i = 0; i < 100; ++i) {
    if (i == 50) {
      loop.controller.set_target(std::numeric_limits<TypeParam>::quiet_NaN());
    }
    ASSERT_EQ(loop.step().amplitude, untold.step().amplitude) << "step " << i;
  }
}

}  // namespace
}  // namespace sonoglide::control::closed_loop_test
