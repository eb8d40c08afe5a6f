/// Pauses of the drive in which the friction force is learnt anew.

#include <gtest/gtest.h>

#include <cmath>

#include "closed_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::relearning_test {
namespace {

template <class Scalar>
class Relearning : public testing::Test {
 protected:
  using Loop = ClosedLoop<RelearningParts<Scalar>>;

  static Loop at_target(double target, const Design& design = {}) {
    Loop loop(design);
    loop.delay_sensor(1);
    loop.set_target(target);
    loop.run(static_cast<int>(design.relearn_every_periods) - 10);
    return loop;
  }
};
TYPED_TEST_SUITE(Relearning, Scalars);

TYPED_TEST(Relearning, PausesForAsLongAsItTakesAndResumesWhereItWas) {
  auto loop = this->at_target(0.5);
  const double before = loop.amplitude();
  int disturbed = 0;
  int relearning = 0;
  for (int i = 0; i < 200; ++i) {
    const auto& command = loop.step();
    relearning += command.state == State::relearning ? 1 : 0;
    disturbed += std::abs(loop.amplitude() - before) > 1e-3 * before ? 1 : 0;
    ASSERT_EQ(command.fault, Fault::none);
  }
  // Shaper 2 + 2, half a period of travel at a tenth of full speed 5, one reading.
  EXPECT_EQ(disturbed, 10);
  EXPECT_GE(relearning, disturbed);
  EXPECT_LE(relearning, disturbed + 5);
  EXPECT_NEAR(loop.ratio(), 0.5, 1e-4);
}

TYPED_TEST(Relearning, FindsTheFrictionForceAfterAJump) {
  for (const double factor : {0.5, 1.5}) {
    auto loop = this->at_target(0.5);
    loop.set_friction_force(0.5 * factor);
    while (loop.step().state != State::relearning) {
    }
    while (loop.step().state == State::relearning) {
    }
    for (int i = 0; i < 300; ++i) {
      loop.step();
      ASSERT_NEAR(loop.ratio(), 0.5, 0.02) << factor << " period " << i;
    }
    EXPECT_NEAR(loop.ratio(), 0.5, 1e-3);
    EXPECT_EQ(loop.command().limit, Limit::none);
  }
}

TYPED_TEST(Relearning, ComesAgainAfterTheStatedPeriods) {
  auto loop = this->at_target(0.5);
  int begun = 0;
  bool before = false;
  for (int i = 0; i < 5000; ++i) {
    const bool now = loop.step().state == State::relearning;
    begun += now && !before ? 1 : 0;
    before = now;
  }
  EXPECT_EQ(begun, 5);
}

TYPED_TEST(Relearning, AStopInAPauseTeachesNothing) {
  auto loop = this->at_target(0.5);
  while (loop.step().state != State::relearning) {
  }
  loop.run(5);
  loop.run(50, 0.0);
  EXPECT_EQ(loop.command().limit, Limit::speed_floor);
  loop.run(200);
  EXPECT_NEAR(loop.ratio(), 0.5, 1e-3);
  EXPECT_EQ(loop.command().fault, Fault::none);
}

TYPED_TEST(Relearning, ASensorThatHasTurnedIsAFault) {
  auto loop = this->at_target(0.9);
  loop.set_friction_force(0.5);
  while (loop.command().fault == Fault::none) {
    auto sample = loop.measurement(0.1);
    if (loop.command().state == State::relearning) {
      sample.friction_force = -sample.friction_force;
    }
    loop.answer(sample);
  }
  EXPECT_EQ(loop.command().fault, Fault::measurement_implausible);
}

TYPED_TEST(Relearning, WithoutADriveThereIsNoPause) {
  typename TestFixture::Loop loop({});
  loop.set_target(1.0);
  for (int i = 0; i < 3000; ++i) {
    ASSERT_EQ(loop.step().state, State::running);
  }
}

/// Between what was learnt and the map that adapts to it too.
TYPED_TEST(Relearning, AStopAtAnyMomentOfAPauseLeavesTheLoopSound) {
  for (int moment = 0; moment < 20; ++moment) {
    auto loop = this->at_target(0.5);
    while (loop.step().state != State::relearning) {
    }
    loop.run(moment);
    loop.run(3, 0.0);
    loop.run(300);
    EXPECT_NEAR(loop.ratio(), 0.5, 1e-3) << moment;
    EXPECT_EQ(loop.command().fault, Fault::none) << moment;
  }
}

}  // namespace
}  // namespace sonoglide::control::relearning_test
