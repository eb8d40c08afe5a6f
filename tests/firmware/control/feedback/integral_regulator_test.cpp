#include "firmware/control/feedback/integral_regulator.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdint>

#include "scalars.hpp"

namespace sonoglide::control::integral_regulator_test {
namespace {

template <class Scalar>
class IntegralRegulatorTest : public testing::Test {
 protected:
  static constexpr double gain = 0.125;
  static constexpr std::uint16_t rest_periods = 12;

  static IntegralRegulator<Scalar, 1> regulator(std::uint16_t hold_periods, double target = 0.25) {
    IntegralRegulator<Scalar, 1> result(
        {scaled<Scalar>(gain), scaled<Scalar>(0.0), hold_periods, rest_periods, 1});
    result.restart(scaled<Scalar>(target));
    return result;
  }
  static double propose(IntegralRegulator<Scalar, 1>& regulator, double target, double measured) {
    return numeric::to_real(regulator.propose(scaled<Scalar>(target), scaled<Scalar>(measured)));
  }
  /// One period without a bound in the way.
  static double step(IntegralRegulator<Scalar, 1>& regulator, double target, double measured) {
    const double commanded = propose(regulator, target, measured);
    regulator.accept(false, false);
    return commanded;
  }
};
TYPED_TEST_SUITE(IntegralRegulatorTest, Scalars);

TYPED_TEST(IntegralRegulatorTest, CommandsTheTargetWhereThereIsNoError) {
  auto regulator = this->regulator(0);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(this->step(regulator, 0.25, 0.25), 0.25);
  }
}

TYPED_TEST(IntegralRegulatorTest, IntegratesTheError) {
  auto regulator = this->regulator(0);
  for (int i = 1; i <= 8; ++i) {
    EXPECT_EQ(this->step(regulator, 0.25, 0.3125), 0.25 - i * this->gain * 0.0625);
  }
}

TYPED_TEST(IntegralRegulatorTest, HoldsForExactlyTheStatedPeriods) {
  auto regulator = this->regulator(3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(this->step(regulator, 0.25, 0.125), 0.25) << "period " << i;
  }
  EXPECT_EQ(this->step(regulator, 0.25, 0.125), 0.25 + this->gain * 0.125);
}

TYPED_TEST(IntegralRegulatorTest, AHoldKeepsWhatWasIntegrated) {
  auto regulator = this->regulator(2);
  for (int i = 0; i < 4; ++i) {
    this->step(regulator, 0.25, 0.125);
  }
  regulator.hold();
  const double held = 0.25 + 2 * this->gain * 0.125;
  EXPECT_EQ(this->step(regulator, 0.25, 0.5), held);
  EXPECT_EQ(this->step(regulator, 0.25, -0.5), held);
  EXPECT_EQ(this->step(regulator, 0.25, 0.125), held + this->gain * 0.125);
}

TYPED_TEST(IntegralRegulatorTest, DoesNotWindUpAtTheMostDrive) {
  auto regulator = this->regulator(0, 0.125);
  for (int i = 0; i < 1000; ++i) {
    this->propose(regulator, 0.125, 0.25);  // too much friction, and no drive left against it
    regulator.accept(true, false);
  }
  EXPECT_EQ(this->step(regulator, 0.125, 0.125), 0.125);
}

TYPED_TEST(IntegralRegulatorTest, DoesNotWindUpAtTheLeastDrive) {
  auto regulator = this->regulator(0, 0.375);
  for (int i = 0; i < 1000; ++i) {
    this->propose(regulator, 0.375, 0.25);  // too little friction, and no drive left to take away
    regulator.accept(false, true);
  }
  EXPECT_EQ(this->step(regulator, 0.375, 0.375), 0.375);
}

TYPED_TEST(IntegralRegulatorTest, ComesBackFromEitherBoundAtOnce) {
  auto most = this->regulator(0, 0.125);
  this->propose(most, 0.125, 0.0625);
  most.accept(true, false);
  EXPECT_EQ(this->step(most, 0.125, 0.125), 0.125 + this->gain * 0.0625);
  auto least = this->regulator(0, 0.375);
  this->propose(least, 0.375, 0.4375);
  least.accept(false, true);
  EXPECT_EQ(this->step(least, 0.375, 0.375), 0.375 - this->gain * 0.0625);
}

TYPED_TEST(IntegralRegulatorTest, ARestartForgetsAndHolds) {
  auto regulator = this->regulator(1);
  for (int i = 0; i < 6; ++i) {
    this->step(regulator, 0.25, 0.125);
  }
  regulator.restart(scaled<TypeParam>(0.25));
  EXPECT_EQ(this->step(regulator, 0.25, 0.125), 0.25);
  EXPECT_EQ(this->step(regulator, 0.25, 0.125), 0.25 + this->gain * 0.125);
}

// What the reading cannot show yet is no error.
TYPED_TEST(IntegralRegulatorTest, ComparesWithTheTargetOfTheDelayAgo) {
  IntegralRegulator<TypeParam, 8> regulator({scaled<TypeParam>(this->gain), TypeParam{}, 0, 0, 5});
  regulator.restart(scaled<TypeParam>(0.25));
  for (int i = 0; i < 40; ++i) {
    const double shown = i < 5 ? 0.25 : 0.375;
    EXPECT_EQ(
        numeric::to_real(regulator.propose(scaled<TypeParam>(0.375), scaled<TypeParam>(shown))),
        0.375);
    regulator.accept(false, false);
  }
}

TYPED_TEST(IntegralRegulatorTest, HoldsForALargeChangeButNotAgainWithinTheRest) {
  auto regulator = this->regulator(3);
  const auto held_periods = [&] {
    int periods = 0;
    double last = this->step(regulator, 0.25, 0.125);
    for (double now = this->step(regulator, 0.25, 0.125); now == last && periods < 20; ++periods) {
      last = now;
      now = this->step(regulator, 0.25, 0.125);
    }
    return periods;
  };
  held_periods();
  regulator.target_changes(scaled<TypeParam>(0.001));
  EXPECT_EQ(held_periods(), 0);
  regulator.target_changes(scaled<TypeParam>(-0.125));
  EXPECT_GT(held_periods(), 0);
  regulator.target_changes(scaled<TypeParam>(0.125));
  EXPECT_EQ(held_periods(), 0);
}

// Bounds reported as the controller reports them; a friction within ±0.9 of a sensor at 2 Fc.
TYPED_TEST(IntegralRegulatorTest, CommandsARatioBetweenNothingAndAllOfIt) {
  EXPECT_TRUE(rc::check([this] {
    auto regulator = this->regulator(*rc::gen::inRange<std::uint16_t>(0, 9));
    const double target = *rc::gen::inRange(5, 46) * 0.01;
    for (int i = 0; i < 300; ++i) {
      const double measured = *rc::gen::inRange(-45, 91) * 0.01;
      const double commanded = this->propose(regulator, target, measured);
      RC_ASSERT(commanded >= 0.0 && commanded <= 0.5);
      regulator.accept(commanded <= 0.01, commanded >= 0.5);
    }
  }));
}

}  // namespace
}  // namespace sonoglide::control::integral_regulator_test
