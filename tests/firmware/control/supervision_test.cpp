/// What the controller no longer believes, or cannot reach, it names.

#include <gtest/gtest.h>

#include "closed_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::supervision_test {
namespace {

template <class Scalar>
class Supervision : public testing::Test {
 protected:
  using Loop = ClosedLoop<ShapedParts<Scalar>>;

  static double mismatch(const Loop& loop, double target) {
    return 2.0 * numeric::to_real(loop.command().commanded_ratio) / target;
  }
};
TYPED_TEST_SUITE(Supervision, Scalars);

TYPED_TEST(Supervision, ASettledLoopHasNoLimit) {
  typename TestFixture::Loop loop({});
  loop.set_target(0.5);
  loop.run(400);
  EXPECT_EQ(loop.command().limit, Limit::none);
  EXPECT_EQ(loop.command().settling, Settling::settled);
  EXPECT_NEAR(this->mismatch(loop, 0.5), 1.0, 0.005);
}

// The presliding travel follows the friction force, which the map takes from the believed one: a
// few per cent.
TYPED_TEST(Supervision, AFrictionForceThatIsNotTheBelievedOneIsNamed) {
  for (const double factor : {0.6, 1.4}) {
    typename TestFixture::Loop loop({}, Contact{0.5 * factor, 1.0108});
    loop.set_target(0.5);
    loop.run(600);
    EXPECT_NEAR(loop.ratio(), 0.5 / factor, 1e-3);
    EXPECT_EQ(loop.command().limit, Limit::mismatch) << factor;
    EXPECT_EQ(loop.command().state, State::limited);
    EXPECT_NEAR(this->mismatch(loop, 0.5), 1.0 / factor, 0.1 / factor);
  }
}

TYPED_TEST(Supervision, ACommandAtTheEndOfRatiosIsNamed) {
  typename TestFixture::Loop loop({}, Contact{0.25, 1.0108});
  loop.set_target(0.8);  // 0.5 is all that this contact shows
  loop.run(300);
  EXPECT_EQ(loop.command().limit, Limit::ratio_end);
  EXPECT_EQ(loop.command().state, State::limited);
}

TYPED_TEST(Supervision, ARatioThatStaysAwayIsNamedAfterTheStatedPeriods) {
  Design design;
  design.gain = 0.0;
  typename TestFixture::Loop loop(design, Contact{0.5, 3.0 * 1.0108});
  loop.set_target(0.6);
  loop.run(design.settling_patience_periods - 5);
  EXPECT_EQ(loop.command().limit, Limit::none);
  loop.run(20);
  EXPECT_EQ(loop.command().limit, Limit::not_settling);
  EXPECT_EQ(loop.command().settling, Settling::offset);
  EXPECT_GT(loop.amplitude(), 0.0);
}

TYPED_TEST(Supervision, AReadingWiredBackwardsIsAFault) {
  const Design design;
  typename TestFixture::Loop loop(design);
  loop.set_target(0.5);
  int steps = 0;
  while (loop.command().fault == Fault::none && steps < 1000) {
    auto sample = loop.measurement(0.1);
    sample.friction_force = scaled<TypeParam>(-0.8) * sample.friction_force;
    loop.answer(sample);
    ++steps;
  }
  EXPECT_EQ(loop.command().fault, Fault::measurement_implausible);
  EXPECT_EQ(loop.command().amplitude, TypeParam{});
  EXPECT_GE(steps, design.implausible_periods);
  EXPECT_LE(steps, design.implausible_periods + 1);
}

TYPED_TEST(Supervision, ACalibrationFindsASensorWiredBackwards) {
  for (const double velocity : {0.1, -0.1}) {
    ClosedLoop<LearningParts<TypeParam>> loop({});
    loop.set_target(0.5);
    for (int i = 0; i < 60; ++i) {
      auto sample = loop.measurement(velocity);
      sample.friction_force = -sample.friction_force;
      loop.answer(sample);
      ASSERT_EQ(loop.command().amplitude, TypeParam{});
    }
    EXPECT_EQ(loop.command().fault, Fault::measurement_implausible);
  }
}

TYPED_TEST(Supervision, AnOffsetIsLearntAsOneWhereTheCalibrationSlidesBothWays) {
  Design design;
  design.total_periods = 130;
  ClosedLoop<LearningParts<TypeParam>> loop(design);
  loop.set_target(0.5);
  for (int i = 0; i < 800; ++i) {
    const auto offset = scaled<TypeParam>(0.1);
    auto sample = loop.measurement(i < 65 ? -0.1 : 0.1);
    sample.friction_force = sample.friction_force + offset;
    loop.answer(sample);
  }
  EXPECT_NEAR(loop.ratio(), 0.5, 1e-3);
  EXPECT_EQ(loop.command().limit, Limit::none);
}

// Nothing ends the drive in between, so that reading and command may stand where they were.
TYPED_TEST(Supervision, ARestartWhileDrivingIsNotTakenForAStuckReading) {
  ClosedLoop<UnshapedParts<TypeParam>> loop({});
  loop.set_target(0.4);
  loop.run(400);
  const auto settled = loop.measurement(0.1);
  loop.controller.start();
  for (int i = 0; i < 400; ++i) {
    loop.answer(settled);
  }
  EXPECT_EQ(loop.command().fault, Fault::none);
  loop.controller.stop();
  loop.answer(settled);
  loop.controller.start();
  for (int i = 0; i < 400; ++i) {
    loop.answer(settled);
  }
  EXPECT_EQ(loop.command().fault, Fault::measurement_stuck);
}

}  // namespace
}  // namespace sonoglide::control::supervision_test
