/// States of the controller: what leads from one to the next, and what each commands.

#include <gtest/gtest.h>

#include "closed_loop.hpp"
#include "firmware/control/force_sensing.hpp"
#include "firmware/control/vibration/fed_forward.hpp"
#include "scalars.hpp"

namespace sonoglide::control::controller_states_test {
namespace {

template <class Scalar>
class ControllerStates : public testing::Test {
 protected:
  using Command = DriveCommand<Scalar>;

  static void expect_undriven(const Command& command, State state, Limit limit, Fault fault) {
    EXPECT_EQ(command.amplitude, Scalar{});
    EXPECT_EQ(command.state, state);
    EXPECT_EQ(command.limit, limit);
    EXPECT_EQ(command.fault, fault);
  }
  static Measurement<Scalar> sample(double force, double velocity) {
    return {scaled<Scalar>(force), scaled<Scalar>(velocity), Quality::good};
  }
};
TYPED_TEST_SUITE(ControllerStates, Scalars);

TYPED_TEST(ControllerStates, IsOffUntilStarted) {
  Controller<ShapedParts<TypeParam>> controller(parameters<ShapedParts<TypeParam>>(Design{}));
  controller.set_target(scaled<TypeParam>(0.2));
  for (int i = 0; i < 5; ++i) {
    this->expect_undriven(controller.step(this->sample(0.5, 0.1)), State::off, Limit::none,
                          Fault::none);
  }
}

TYPED_TEST(ControllerStates, RunsAtOnceWhereTheFrictionForceIsTrusted) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.set_target(0.4);
  const auto& command = loop.step();
  EXPECT_EQ(command.state, State::running);
  EXPECT_EQ(command.limit, Limit::none);
  EXPECT_GT(loop.amplitude(), 0.0);
}

TYPED_TEST(ControllerStates, HasNoTargetBeforeOneIsSet) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  for (int i = 0; i < 50; ++i) {
    this->expect_undriven(loop.step(), State::running, Limit::none, Fault::none);
  }
}

TYPED_TEST(ControllerStates, CalibratesUndrivenForTheStatedSamples) {
  const Design design;
  ClosedLoop<LearningParts<TypeParam>> loop(design);
  loop.set_target(0.4);
  for (unsigned i = 1; i < design.settle_periods + design.average_periods; ++i) {
    this->expect_undriven(loop.step(), State::calibrating, Limit::none, Fault::none);
  }
  // The friction force is worked out in the period of the last sample, the drive begins after it.
  this->expect_undriven(loop.step(), State::calibrating, Limit::none, Fault::none);
  EXPECT_EQ(loop.step().state, State::running);
  EXPECT_GT(loop.amplitude(), 0.0);
}

TYPED_TEST(ControllerStates, CalibrationBeginsAnewAfterASlidingThatIsTooSlow) {
  const Design design;
  ClosedLoop<LearningParts<TypeParam>> loop(design);
  loop.set_target(0.4);
  loop.run(10);
  for (int i = 0; i < 100; ++i) {
    this->expect_undriven(loop.step(0.01), State::calibrating, Limit::speed_floor, Fault::none);
  }
  int learning = 0;
  while (loop.step().state == State::calibrating && learning < 1000) {
    ++learning;
  }
  EXPECT_EQ(learning, static_cast<int>(design.settle_periods + design.average_periods));
}

TYPED_TEST(ControllerStates, CalibrationMakesUpForAWrongFrictionForce) {
  for (const double error : {0.7, 1.3}) {
    Design design;
    design.friction_force = 0.5 * error;
    ClosedLoop<LearningParts<TypeParam>> learning(design);
    learning.set_target(0.4);
    learning.run(400);
    EXPECT_NEAR(learning.ratio(), 0.4, 1e-4) << "believed Fc times " << error;

    ClosedLoop<ShapedParts<TypeParam>> trusting(design);
    trusting.set_target(0.4);
    trusting.run(400);
    EXPECT_NEAR(trusting.ratio(), 0.4 * error, 1e-4) << "believed Fc times " << error;
  }
}

TYPED_TEST(ControllerStates, CalibrationFeedsTheFeedforwardToo) {
  Design design;
  design.friction_force = 0.35;
  design.gain = 0.0;
  ClosedLoop<LearningParts<TypeParam>> loop(design);
  loop.set_target(0.4);
  loop.run(200);
  EXPECT_NEAR(loop.ratio(), 0.4, 0.002);
}

TYPED_TEST(ControllerStates, TooSmallAFrictionForceIsAFault) {
  const Design design;
  ClosedLoop<LearningParts<TypeParam>> loop(design);
  loop.set_target(0.4);
  const auto faint = this->sample(0.9 / 1024.0, 0.1);
  for (unsigned i = 1; i < design.settle_periods + design.average_periods; ++i) {
    ASSERT_EQ(loop.answer(faint).state, State::calibrating);
  }
  for (int i = 0; i < 100; ++i) {
    this->expect_undriven(loop.answer(faint), State::fault, Limit::none,
                          Fault::friction_not_learnt);
  }
  loop.controller.start();
  loop.run(static_cast<int>(design.settle_periods + design.average_periods));
  EXPECT_EQ(loop.step().state, State::running);
}

TYPED_TEST(ControllerStates, TooSmallABelievedFrictionForceNeverDrives) {
  Design design;
  design.friction_force = 0.9 / 1024.0;
  ClosedLoop<UnshapedParts<TypeParam>> loop(design);
  loop.set_target(0.4);
  for (int i = 0; i < 20; ++i) {
    const auto command = loop.answer(this->sample(0.5 / 1024.0 + 1e-5 * i, 0.01 + 0.02));
    EXPECT_EQ(command.amplitude, TypeParam{});
    EXPECT_EQ(command.state, State::fault);
  }
}

TYPED_TEST(ControllerStates, StopTakesTheDriveAway) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.set_target(0.4);
  loop.run(50);
  ASSERT_GT(loop.amplitude(), 0.0);
  loop.controller.stop();
  for (int i = 0; i < 20; ++i) {
    this->expect_undriven(loop.step(), State::off, Limit::none, Fault::none);
  }
}

TYPED_TEST(ControllerStates, StopForgetsAFault) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.set_target(0.4);
  auto missing = loop.measurement(0.1);
  missing.quality = Quality::missing;
  ASSERT_EQ(loop.answer(missing).state, State::fault);
  loop.controller.stop();
  this->expect_undriven(loop.step(), State::off, Limit::none, Fault::none);
}

// After a stop or a reversal the contact is back in its presliding: what was learnt before is void.
TYPED_TEST(ControllerStates, AnInterruptedCalibrationBeginsAnew) {
  const Design design;
  const int periods = static_cast<int>(design.settle_periods + design.average_periods);
  for (const double interruption : {0.0, -0.1}) {
    ClosedLoop<LearningParts<TypeParam>> loop(design);
    loop.set_target(0.4);
    loop.run(periods - 1);
    ASSERT_EQ(loop.command().state, State::calibrating);
    loop.step(interruption);
    const double velocity = interruption < 0.0 ? interruption : 0.1;
    const int counted = interruption < 0.0 ? 1 : 0;  // a reversed sliding is a sample already
    loop.run(periods - 1 - counted, velocity);
    EXPECT_EQ(loop.command().state, State::calibrating) << interruption;
    loop.step(velocity);
    EXPECT_EQ(loop.command().state, State::calibrating) << interruption;
    loop.step(velocity);
    EXPECT_EQ(loop.command().state, State::running) << interruption;
  }
}

TYPED_TEST(ControllerStates, ARestIsAPeriodWithoutDrive) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.set_target(0.4);
  loop.run(50);
  this->expect_undriven(loop.controller.rest(), State::off, Limit::none, Fault::none);
}

/// Keeps the mean friction force that a mode of the vibration is told to expect.
template <class S>
struct ToldFriction : FedForward<S> {
  using FedForward<S>::FedForward;
  template <class Friction>
  static void balance(const DriveCommand<S>& /*command*/, const Friction& friction) {
    told = friction();
  }
  static inline S told{};
};

TYPED_TEST(ControllerStates, TheFrictionThatIsExpectedIsThatOfTheTargetOrUndrivenTheReading) {
  using S = TypeParam;
  using Told = ToldFriction<S>;
  ClosedLoop<Parts<S, TrustedFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>, NoShaping<S>,
                   IntegralRegulator<S, longest_delay>, NoRelearning<S>, Told>>
      loop({});
  loop.controller.stop();
  loop.answer(this->sample(0.125, 0.1));
  EXPECT_EQ(Told::told, scaled<S>(0.125));
  loop.controller.start();
  loop.step();
  EXPECT_NEAR(numeric::to_real(Told::told), 0.5, 1e-6);
  loop.set_target(0.4);
  loop.step();
  EXPECT_NEAR(numeric::to_real(Told::told), 0.2, 1e-6);
  loop.step(-0.1);
  EXPECT_NEAR(numeric::to_real(Told::told), -0.2, 1e-6);
  loop.answer(this->sample(0.125, 0.001));  // below the speed floor
  EXPECT_EQ(Told::told, scaled<S>(0.125));
  auto fast = this->sample(0.25, 0.9);
  fast.velocity_at_rail = true;
  loop.answer(fast);
  EXPECT_EQ(Told::told, scaled<S>(0.25));
}

/// Nothing but the map tells it the drive.
TYPED_TEST(ControllerStates, WithoutAForceSensorNoReadingOfTheForceMatters) {
  using S = TypeParam;
  using Blind = Parts<S, TrustedFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>, NoShaping<S>,
                      NoFeedback<S>, NoRelearning<S>, FedForward<S>, NoForceSensor>;
  const Design design;
  typename Controller<Blind>::Parameters all{};
  all.friction_force = scaled<S>(design.friction_force);
  all.smallest_friction = scaled<S>(design.smallest_friction);
  all.speed_floor = scaled<S>(design.speed_floor);
  all.standstill = {design.standstill_hold_periods, scaled<S>(design.standstill_fall)};
  fill<S>(design, all.feedforward);
  Controller<Blind> controller(all);
  controller.start();
  controller.set_target(scaled<S>(0.2));
  for (int i = 0; i < 200; ++i) {
    auto sample = this->sample(0.9 - 0.009 * i, 0.1);
    sample.quality = i % 2 == 0 ? Quality::good : Quality::saturated;
    const auto command = controller.step(sample);
    ASSERT_EQ(command.state, State::running);
    ASSERT_EQ(command.settling, Settling::pending);
    ASSERT_NEAR(Contact{}.ratio(numeric::to_real(command.amplitude), 0.1), 0.4, 0.002);
  }
  EXPECT_EQ(controller.step(this->sample(0.9, 0.001)).limit, Limit::speed_floor);
}

TYPED_TEST(ControllerStates, AStartWhileItDrivesCalibratesAgainWithoutDrive) {
  const Design design;
  const int periods = static_cast<int>(design.settle_periods + design.average_periods);
  ClosedLoop<LearningParts<TypeParam>> loop(design);
  loop.set_target(0.4);
  loop.run(periods + 100);
  ASSERT_EQ(loop.command().state, State::running);
  loop.controller.start();
  for (int i = 0; i < periods; ++i) {
    this->expect_undriven(loop.step(), State::calibrating, Limit::none, Fault::none);
  }
  loop.run(200);
  EXPECT_NEAR(loop.ratio(), 0.4, 1e-3);
}

}  // namespace
}  // namespace sonoglide::control::controller_states_test
