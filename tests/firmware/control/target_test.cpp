#include "firmware/control/target.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>

#include "closed_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::target_test {
namespace {

template <class S, class Target>
using HoldingParts = Parts<S, LearntFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>,
                           NotchShaper<S, longest_spacing>, IntegralRegulator<S, longest_delay>,
                           PeriodicRelearning<S>, FedForward<S>, ForceSensor, Target>;

template <class Scalar>
class Targets : public testing::Test {
 protected:
  static double real(Scalar value) { return numeric::to_real(value); }
};
TYPED_TEST_SUITE(Targets, Scalars);

/// Simulations of every scene have it, images of a ratio do not. Targets, speed, noise and friction
/// change at random, and with relearning the loop pauses.
TYPED_TEST(Targets, AForceTargetThatHoldsNoneIsARatioTargetBitForBit) {
  using Ratio = HoldingParts<TypeParam, RatioTarget<TypeParam>>;
  using Either = HoldingParts<TypeParam, ForceTarget<TypeParam>>;
  Design design;
  design.relearn_every_periods = 300;
  auto of_either = parameters<Either>(design);
  of_either.target = {false};
  Controller<Either> either(of_either);
  either.start();
  ClosedLoop<Ratio> loop(design);
  loop.delay_sensor(1);
  std::mt19937 random(5);
  const auto between = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 3000; ++i) {
    if (i % 250 == 0) {
      const auto target = scaled<TypeParam>(between(0.1, 0.49));
      loop.controller.set_target(target);
      either.set_target(target);
      loop.set_friction_force(between(0.45, 0.55));
    }
    const auto sample = loop.measurement(between(0.099, 0.101), between(-0.005, 0.005));
    const auto a = loop.answer(sample);
    const auto b = either.step(sample);
    ASSERT_TRUE(a.amplitude == b.amplitude && a.commanded_ratio == b.commanded_ratio) << i;
    ASSERT_TRUE(a.state == b.state && a.limit == b.limit && a.settling == b.settling) << i;
  }
  EXPECT_NE(loop.command().state, State::fault);
}

TYPED_TEST(Targets, AForceIsARatioOfTheFrictionBelievedOrOfItself) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> part(0.01, 0.99);
  for (int i = 0; i < 1000; ++i) {
    const double believed = part(random);
    const double force = part(random);
    FrictionLevel<TypeParam> level(scaled<TypeParam>(believed));
    ForceTarget<TypeParam> target({true});
    auto ratio = scaled<TypeParam>(force);
    target.take(
        ratio, [&] { return scaled<TypeParam>(believed); }, level);
    const double whole = std::max(believed, force);
    const double rounding = sizeof(TypeParam) < 4 ? 5e-3 : 1e-6;
    EXPECT_NEAR(this->real(level.force()), whole, rounding * whole);
    EXPECT_NEAR(this->real(ratio), 0.5 * force / whole, rounding);
    EXPECT_TRUE(ratio < scaled<TypeParam>(0.5));
    EXPECT_TRUE(target.give_back(ratio) == scaled<TypeParam>(force));
  }
}

/// A calibration without a contact has learnt no friction, or one that pulls.
TYPED_TEST(Targets, ALevelIsUsableWhateverIsBelieved) {
  FrictionLevel<TypeParam> level(scaled<TypeParam>(0.5));
  ForceTarget<TypeParam> target({true});
  for (const double believed : {-0.9, 0.0, 1e-4}) {
    for (const double force : {0.0, 1e-4, 0.3}) {
      auto ratio = scaled<TypeParam>(force);
      target.take(
          ratio, [&] { return scaled<TypeParam>(believed); }, level);
      EXPECT_NEAR(this->real(level.force()), std::max(force, 1.0 / 1024.0), 1e-3);
      EXPECT_TRUE(FrictionLevel<TypeParam>::smallest() <= level.force());
    }
  }
}

TYPED_TEST(Targets, AForceOfZeroIsNoDrive) {
  FrictionLevel<TypeParam> level(scaled<TypeParam>(0.5));
  ForceTarget<TypeParam> target({true});
  for (const double force : {0.3, 0.0, 0.3, -0.2}) {
    auto ratio = scaled<TypeParam>(force);
    target.take(
        ratio, [] { return scaled<TypeParam>(0.5); }, level);
    EXPECT_EQ(ratio == scaled<TypeParam>(0.5), !(force > 0.0));
  }
}

/// The gain of the loop is that of the friction believed, whatever the friction.
TYPED_TEST(Targets, ADeviationCountsByTheCommandOverTheTarget) {
  FrictionLevel<TypeParam> level(scaled<TypeParam>(0.5));
  ForceTarget<TypeParam> target({true});
  auto ratio = scaled<TypeParam>(0.2);
  target.take(
      ratio, [] { return scaled<TypeParam>(0.5); }, level);
  const double rounding = sizeof(TypeParam) < 4 ? 4e-3 : 1e-6;
  const std::pair<double, double> factors[] = {{0.2, 1.0}, {0.3, 1.5}, {0.5, 1.998}, {0.05, 0.5}};
  for (const auto& [commanded, factor] : factors) {
    for (const double deviation : {-0.1, 0.0, 0.05}) {
      const TypeParam reading =
          target.reading(scaled<TypeParam>(0.2 + deviation), ratio, scaled<TypeParam>(commanded));
      EXPECT_NEAR(this->real(reading), 0.2 + factor * deviation, rounding);
    }
  }
  EXPECT_TRUE(target.judged(scaled<TypeParam>(0.9)) == scaled<TypeParam>(0.5));
  EXPECT_TRUE(target.judged(scaled<TypeParam>(-0.3)) == scaled<TypeParam>(-0.3));
}

}  // namespace
}  // namespace sonoglide::control::target_test
