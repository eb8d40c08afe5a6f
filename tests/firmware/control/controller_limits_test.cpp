/// Limits: named while they act, harmless afterwards.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "closed_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::controller_limits_test {
namespace {

/// The largest amplitude: the last converter code.
constexpr double full_drive = numeric::from_code<double>(INT32_MAX);

template <class Scalar>
class ControllerLimits : public testing::Test {};
TYPED_TEST_SUITE(ControllerLimits, Scalars);

TYPED_TEST(ControllerLimits, AnUnreachableTargetIsNamedAtOnceAndGetsFullDrive) {
  const Design design;
  ClosedLoop<ShapedParts<TypeParam>> loop(design);
  loop.set_target(0.1);  // at half speed it takes several times the drive there is
  EXPECT_EQ(loop.step(0.5).limit, Limit::actuator);
  loop.run(2 * design.spacing, 0.5);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_NEAR(loop.amplitude(), full_drive, 3.0 * resolution<TypeParam>());
    const auto& command = loop.step(0.5);
    ASSERT_EQ(command.limit, Limit::actuator);
    ASSERT_EQ(command.state, State::limited);
    ASSERT_EQ(command.fault, Fault::none);
  }
}

TYPED_TEST(ControllerLimits, AnUnreachableTargetLeavesNothingBehind) {
  const Design design;
  ClosedLoop<ShapedParts<TypeParam>> used(design);
  used.set_target(0.1);
  used.run(1000, 0.5);
  used.set_target(0.7);
  ClosedLoop<ShapedParts<TypeParam>> fresh(design);
  fresh.set_target(0.7);
  for (int i = 0; i < 300; ++i) {
    const auto& command = used.step(0.5);
    fresh.step(0.5);
    if (i >= 2 * design.spacing) {
      ASSERT_NEAR(used.amplitude(), fresh.amplitude(), 1e-6) << "step " << i;
      ASSERT_EQ(command.limit, Limit::none) << "step " << i;
    }
  }
  EXPECT_NEAR(used.ratio(), 0.7, 1e-4);
}

template <class S>
using LimitedDriveParts =
    Parts<S, TrustedFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>,
          NotchShaper<S, longest_spacing>, IntegralRegulator<S, longest_delay>, NoRelearning<S>,
          FedForward<S>, ForceSensor, RatioTarget<S>, DriveLimit<S>>;

TYPED_TEST(ControllerLimits, ADriveLimitIsNeverPassedAndNamedWhereItActs) {
  Design design;
  design.drive_limit = 0.25;
  ClosedLoop<LimitedDriveParts<TypeParam>> loop(design);
  loop.set_target(0.1);
  for (int i = 0; i < 500; ++i) {
    const auto& command = loop.step(0.1);
    ASSERT_LE(loop.amplitude(), 0.25);
    ASSERT_EQ(command.limit, Limit::actuator);
  }
  EXPECT_EQ(loop.amplitude(), 0.25);
}

// Shaping may overshoot its input; the limit holds behind it.
TYPED_TEST(ControllerLimits, ADriveLimitHoldsWhileTargetsChange) {
  Design design;
  design.drive_limit = 0.25;
  ClosedLoop<LimitedDriveParts<TypeParam>> loop(design);
  for (int i = 0; i < 2000; ++i) {
    if (i % 7 == 0) {
      loop.set_target(i % 2 == 0 ? 0.3 : 0.95);
    }
    loop.step(0.1 + 0.05 * (i % 13) / 13.0);
    ASSERT_LE(loop.amplitude(), 0.25) << i;
  }
}

TYPED_TEST(ControllerLimits, ADriveLimitLeavesNothingBehindAndDoesNothingBelow) {
  Design design;
  design.drive_limit = 0.25;
  ClosedLoop<LimitedDriveParts<TypeParam>> limited(design);
  limited.set_target(0.1);
  limited.run(1000);
  limited.set_target(0.7);
  limited.run(300);
  EXPECT_NEAR(limited.ratio(), 0.7, 1e-4);
  ClosedLoop<LimitedDriveParts<TypeParam>> below(design);
  ClosedLoop<ShapedParts<TypeParam>> free(design);
  below.set_target(0.7);
  free.set_target(0.7);
  for (int i = 0; i < 300; ++i) {
    ASSERT_EQ(below.step().amplitude, free.step().amplitude) << i;
  }
}

TYPED_TEST(ControllerLimits, AWholeTargetIsNoDriveAtAll) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.set_target(0.4);
  loop.run(100);
  loop.set_target(1.0);
  loop.run(2 * Design{}.spacing + 1);
  for (int i = 0; i < 100; ++i) {
    const auto& command = loop.step();
    ASSERT_EQ(command.amplitude, TypeParam{});
    ASSERT_EQ(command.limit, Limit::none);
  }
}

// Undriven friction reads as 0.77 or 1.18 where Fc is believed wrong; no drive can alter that.
TYPED_TEST(ControllerLimits, AWholeTargetLeavesNothingBehind) {
  for (const double error : {0.85, 1.3}) {
    Design design;
    design.friction_force = 0.5 * error;
    ClosedLoop<ShapedParts<TypeParam>> used(design);
    used.set_target(1.0);
    used.run(1000);
    used.set_target(0.5);
    ClosedLoop<ShapedParts<TypeParam>> fresh(design);
    fresh.set_target(0.5);
    for (int i = 0; i < 300; ++i) {
      used.step();
      fresh.step();
      ASSERT_NEAR(used.amplitude(), fresh.amplitude(), 1e-6)
          << "believed Fc times " << error << ", step " << i;
    }
  }
}

TYPED_TEST(ControllerLimits, TheDriveChangesNoFasterThanTheSlewLimit) {
  const Design design;
  ClosedLoop<SlewingParts<TypeParam>> loop(design);
  double before = 0.0;
  int slewing = 0;
  for (const double target : {0.2, 0.9, 0.3, 1.0, 0.15}) {
    loop.set_target(target);
    for (int i = 0; i < 150; ++i) {
      const auto& command = loop.step();
      const double change = std::abs(loop.amplitude() - before);
      ASSERT_LE(change, design.slew_per_period + 2.0 * resolution<TypeParam>());
      if (change > 0.999 * design.slew_per_period) {
        ++slewing;
        ASSERT_EQ(command.limit, Limit::slew);
        ASSERT_EQ(command.state, State::limited);
      }
      before = loop.amplitude();
    }
    EXPECT_EQ(loop.command().limit, Limit::none);
    EXPECT_NEAR(loop.ratio(), target, 1e-3);
  }
  EXPECT_GE(slewing, 50);
}

TYPED_TEST(ControllerLimits, AChangeWithinTheSlewLimitIsNotNamed) {
  Design design;
  design.slew_per_period = 0.9;
  ClosedLoop<SlewingParts<TypeParam>> loop(design);
  for (int i = 0; i < 200; ++i) {
    loop.set_target(0.15 + 0.004 * ((i * 53) % 200));
    ASSERT_EQ(loop.step(0.03).limit, Limit::none) << "step " << i;
  }
}

// While the drive slews the error is large; none of it may be kept.
TYPED_TEST(ControllerLimits, SlewingDoesNotWindUp) {
  Design design;
  design.slew_per_period = 0.004;
  design.hold_periods = 0;
  ClosedLoop<SlewingParts<TypeParam>> loop(design);
  loop.set_target(0.2);
  double lowest = 1.0;
  for (int i = 0; i < 600; ++i) {
    loop.step();
    lowest = std::min(lowest, loop.ratio());
  }
  EXPECT_GT(lowest, 0.19);
  EXPECT_NEAR(loop.ratio(), 0.2, 1e-4);
}

TYPED_TEST(ControllerLimits, BelowTheSpeedFloorTheDriveIsHeldAndThenGoesOn) {
  const Design design;
  ClosedLoop<ShapedParts<TypeParam>> loop(design);
  loop.set_target(0.5);
  loop.run(200, 0.03);
  double velocity = 0.03;
  constexpr double change = 1e-4;
  int running = 0;
  int held_for = 0;
  double held = 0.0;
  while (velocity > -0.05) {
    velocity -= change;
    const auto& command = loop.step(velocity);
    const double foreseen = std::abs(velocity - design.lead_periods * change);
    if (foreseen > design.speed_floor + 1e-6) {
      ASSERT_EQ(command.limit, Limit::none) << "velocity " << velocity;
      ASSERT_EQ(command.state, State::running);
      ++running;
    } else if (foreseen < design.speed_floor - 1e-6) {
      ASSERT_EQ(command.limit, Limit::speed_floor) << "velocity " << velocity;
      ASSERT_EQ(command.state, State::limited);
      if (++held_for == 2 * design.spacing + 1) {
        held = loop.amplitude();
        EXPECT_GT(held, design.speed_floor);
      } else if (held_for > 2 * design.spacing + 1) {
        ASSERT_NEAR(loop.amplitude(), held, 3.0 * resolution<TypeParam>());
      }
    }
  }
  EXPECT_GE(running, 250);
  EXPECT_GT(held_for, 500);
  EXPECT_NEAR(loop.ratio(), 0.5, 0.01);
  loop.run(200, velocity);
  EXPECT_NEAR(loop.ratio(), 0.5, 1e-4);
}

TYPED_TEST(ControllerLimits, AWholeTargetTakesTheDriveAwayAtRestToo) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.set_target(0.4);
  loop.run(100);
  loop.run(100, 0.0);
  EXPECT_EQ(loop.command().limit, Limit::speed_floor);
  EXPECT_GT(loop.amplitude(), 0.1);
  loop.set_target(1.0);
  loop.run(2 * Design{}.spacing + 1, 0.0);
  EXPECT_EQ(loop.command().amplitude, TypeParam{});
}

TYPED_TEST(ControllerLimits, TheDriveNeverStartsBelowTheSpeedFloor) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.set_target(0.5);
  for (int i = 0; i < 50; ++i) {
    const auto& command = loop.step(0.01);
    ASSERT_EQ(command.amplitude, TypeParam{});
    ASSERT_EQ(command.limit, Limit::speed_floor);
  }
}

// A velocity converter at its end: the drive is held, for as long as below the speed floor, then
// falls to zero; and comes back with the velocity.
TYPED_TEST(ControllerLimits, AVelocityAtItsRailIsNamedAndDoesNotRaiseTheDrive) {
  Design design;
  design.standstill_hold_periods = 100;
  for (const double sign : {1.0, -1.0}) {
    ClosedLoop<ShapedParts<TypeParam>> loop(design);
    loop.set_target(0.4);
    loop.run(400, sign * 0.1);
    const double held = loop.amplitude();
    for (int i = 0; i < 300; ++i) {
      // The contact slides on as before.
      auto measured = loop.measurement(sign * 0.1);
      measured.sliding_velocity = numeric::from_real<TypeParam>(sign * full_drive);
      measured.velocity_at_rail = true;
      const auto& command = loop.answer(measured);
      ASSERT_EQ(command.state, State::limited) << i;
      ASSERT_EQ(command.limit, Limit::velocity_at_rail) << i;
      ASSERT_EQ(command.fault, Fault::none) << i;
      ASSERT_LE(loop.amplitude(), held + 1e-4) << i;
      if (i < 100) {
        ASSERT_NEAR(loop.amplitude(), held, 1e-4) << i;
      }
    }
    EXPECT_EQ(loop.amplitude(), 0.0);
    loop.run(400, sign * 0.1);
    EXPECT_EQ(loop.command().limit, Limit::none);
    EXPECT_NEAR(loop.ratio(), 0.4, 1e-3);
  }
}

TYPED_TEST(ControllerLimits, TheDriveDoesNotStartWithTheVelocityAtItsRail) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.set_target(0.5);
  for (int i = 0; i < 50; ++i) {
    auto measured = loop.measurement(0.1);
    measured.velocity_at_rail = true;
    const auto& command = loop.answer(measured);
    ASSERT_EQ(command.amplitude, TypeParam{});
    ASSERT_EQ(command.limit, Limit::velocity_at_rail);
  }
}

// The codes one inside either end; the lowest itself has no magnitude in fixed point.
TYPED_TEST(ControllerLimits, AnyTargetIsOutOfReachAtFullSpeed) {
  for (const double velocity : {full_drive, -full_drive}) {
    ClosedLoop<ShapedParts<TypeParam>> loop({});
    loop.set_target(0.5);
    loop.run(10, velocity);
    EXPECT_EQ(loop.step(velocity).limit, Limit::actuator);
    EXPECT_NEAR(loop.amplitude(), full_drive, 3.0 * resolution<TypeParam>());
  }
}

TEST(ControllerLimitsSaturation, TheLowestVelocityCodeIsFullSpeed) {
  ClosedLoop<ShapedParts<Saturated>> loop({});
  loop.set_target(0.5);
  loop.run(10, -1.0);
  EXPECT_EQ(loop.step(-1.0).limit, Limit::actuator);
  EXPECT_NEAR(loop.amplitude(), full_drive, 0x1p-29);
}

}  // namespace
}  // namespace sonoglide::control::controller_limits_test
