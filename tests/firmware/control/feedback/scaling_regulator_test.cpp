#include "firmware/control/feedback/scaling_regulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scalars.hpp"

namespace sonoglide::control::scaling_regulator_test {
namespace {

/// An inverse map for what a regulator needs of one: V = 0.1/ratio, the ratio on base 2.
double velocity_for(double half_ratio) {
  return std::min(0.99, 0.1 / half_ratio);
}

/// A contact behind a sensor that reads every velocity too large by one factor.
template <class Scalar>
class ScalingRegulatorTest : public testing::Test {
 protected:
  static ScalingRegulator<Scalar, 1> regulator(bool scales, double target) {
    typename ScalingRegulator<Scalar, 1>::Parameters parameters{};
    parameters.gain = scaled<Scalar>(0.125);
    parameters.rest_periods = 12;
    parameters.delay_periods = 1;
    parameters.scales = scales;
    ScalingRegulator<Scalar, 1> result(parameters);
    result.restart(scaled<Scalar>(target));
    return result;
  }

  /// One period at this target. @return the friction ratio on base 2 that it ends at
  static double period(ScalingRegulator<Scalar, 1>& regulator, double target, double measured,
                       double too_large) {
    regulator.learn_scale(
        [](Scalar ratio) { return scaled<Scalar>(velocity_for(numeric::to_real(ratio))); });
    const Scalar ratio = regulator.propose(scaled<Scalar>(target), scaled<Scalar>(measured));
    const Scalar wanted = regulator.scaled(scaled<Scalar>(velocity_for(numeric::to_real(ratio))));
    const double commanded = numeric::to_real(ratio);
    regulator.accept(velocity_for(commanded) == 0.99, commanded == 0.5);
    return std::min(0.99, 0.1 * too_large / numeric::to_real(wanted));
  }

  static double settle(ScalingRegulator<Scalar, 1>& regulator, double target, double too_large) {
    double measured = target;
    for (int i = 0; i < 400; ++i) {
      measured = period(regulator, target, measured, too_large);
    }
    return measured;
  }

  static constexpr double tolerance = 1e-5;
};
TYPED_TEST_SUITE(ScalingRegulatorTest, Scalars);

TYPED_TEST(ScalingRegulatorTest, LearnsTheFactorOnceForEveryTarget) {
  for (const double too_large : {0.75, 0.9, 1.1, 1.25}) {
    auto regulator = this->regulator(true, 0.3);
    double before = this->settle(regulator, 0.3, too_large);
    EXPECT_NEAR(before, 0.3, this->tolerance);
    for (const double target : {0.2, 0.35, 0.25}) {
      regulator.target_changes(scaled<TypeParam>(target - before));
      EXPECT_NEAR(this->period(regulator, target, before, too_large), target, this->tolerance)
          << too_large << ' ' << target;
      before = this->settle(regulator, target, too_large);
    }
  }
}

TYPED_TEST(ScalingRegulatorTest, WithoutAScaleTheErrorComesBackWithEachTarget) {
  auto regulator = this->regulator(false, 0.3);
  EXPECT_NEAR(this->settle(regulator, 0.3, 1.25), 0.3, this->tolerance);
  regulator.target_changes(scaled<TypeParam>(-0.1));
  EXPECT_GT(std::abs(this->period(regulator, 0.2, 0.3, 1.25) - 0.2), 0.01);
}

TYPED_TEST(ScalingRegulatorTest, TellsTheRatioThatTheScaledVelocityStandsFor) {
  auto regulator = this->regulator(true, 0.3);
  EXPECT_NEAR(numeric::to_real(regulator.implied(scaled<TypeParam>(0.3))), 0.3, this->tolerance);
  this->settle(regulator, 0.3, 1.25);
  regulator.target_changes(scaled<TypeParam>(-0.1));
  this->settle(regulator, 0.2, 1.25);
  EXPECT_NEAR(numeric::to_real(regulator.implied(scaled<TypeParam>(0.2))), 0.2 / 1.25,
              10.0 * this->tolerance);
}

TYPED_TEST(ScalingRegulatorTest, ARestartForgetsTheFactorAndNoDriveLearnsNone) {
  auto regulator = this->regulator(true, 0.3);
  this->settle(regulator, 0.3, 1.25);
  regulator.target_changes(scaled<TypeParam>(-0.1));
  this->settle(regulator, 0.2, 1.25);
  regulator.restart(scaled<TypeParam>(0.3));
  EXPECT_EQ(numeric::to_real(regulator.scaled(scaled<TypeParam>(0.25))), 0.25);
  regulator.target_changes(scaled<TypeParam>(0.2));
  regulator.learn_scale([](TypeParam) { return TypeParam{}; });
  EXPECT_EQ(numeric::to_real(regulator.scaled(scaled<TypeParam>(0.25))), 0.25);
}

// Where the drive is zero at the target or at what was commanded for it, their quotient says nothing.
TYPED_TEST(ScalingRegulatorTest, NoDriveAtEitherRatioLearnsNoFactor) {
  for (const bool at_target : {true, false}) {
    auto regulator = this->regulator(true, 0.3);
    this->settle(regulator, 0.3, 1.25);
    regulator.target_changes(scaled<TypeParam>(-0.1));
    regulator.learn_scale([at_target](TypeParam ratio) {
      const bool is_target = std::abs(numeric::to_real(ratio) - 0.3) < 0.01;
      return scaled<TypeParam>(is_target == at_target ? 0.0 : 0.4);
    });
    EXPECT_EQ(numeric::to_real(regulator.scaled(scaled<TypeParam>(0.25))), 0.25) << at_target;
  }
}

TYPED_TEST(ScalingRegulatorTest, LearnsTheFactorOnlyWithANewTarget) {
  auto regulator = this->regulator(true, 0.3);
  const auto factor = [&regulator] {
    return numeric::to_real(regulator.scaled(scaled<TypeParam>(0.25))) / 0.25;
  };
  this->settle(regulator, 0.3, 1.25);
  EXPECT_EQ(factor(), 1.0);
  regulator.target_changes(scaled<TypeParam>(-0.1));
  this->period(regulator, 0.2, 0.3, 1.25);
  const double learnt = factor();
  EXPECT_NEAR(learnt, 1.25, 1e-3);
  this->settle(regulator, 0.2, 1.5);
  EXPECT_EQ(factor(), learnt);
}

TYPED_TEST(ScalingRegulatorTest, ItsFactorStaysWithinTwo) {
  auto regulator = this->regulator(true, 0.3);
  for (int i = 0; i < 8; ++i) {
    this->settle(regulator, i % 2 == 0 ? 0.3 : 0.2, 6.0);
    regulator.target_changes(scaled<TypeParam>(i % 2 == 0 ? -0.1 : 0.1));
  }
  const double scaled_velocity = numeric::to_real(regulator.scaled(scaled<TypeParam>(0.25)));
  EXPECT_LE(scaled_velocity, 0.5);
  EXPECT_GT(scaled_velocity, 0.25);
}

TYPED_TEST(ScalingRegulatorTest, LearnsNothingFromASmallChangeOfTheTarget) {
  for (const bool large : {false, true}) {
    auto regulator = this->regulator(true, 0.3);
    regulator.target_changes(scaled<TypeParam>(large ? 0.1 : 1e-4));
    regulator.target_changes(scaled<TypeParam>(1e-4));
    int asked = 0;
    regulator.learn_scale([&](TypeParam /*ratio*/) {
      ++asked;
      return scaled<TypeParam>(0.5);
    });
    EXPECT_EQ(asked > 0, large);
  }
}

TYPED_TEST(ScalingRegulatorTest, WithoutScalingImpliesTheRatioItself) {
  EXPECT_EQ(this->regulator(false, 0.3).implied(scaled<TypeParam>(0.2)), scaled<TypeParam>(0.2));
}

}  // namespace
}  // namespace sonoglide::control::scaling_regulator_test
