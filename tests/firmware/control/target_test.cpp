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

/// Simulations of every scene have it, images of a ratio do not.
TYPED_TEST(Targets, AForceTargetThatHoldsNoneIsARatioTargetBitForBit) {
  using Ratio = HoldingParts<TypeParam, RatioTarget<TypeParam>>;
  using Either = HoldingParts<TypeParam, ForceTarget<TypeParam>>;
  Design design;
  design.relearn_every_periods = 300;
  auto of_either = parameters<Either>(design);
  of_either.target = {false};
  Controller<Ratio> ratio(parameters<Ratio>(design));
  Controller<Either> either(of_either);
  ratio.start();
  either.start();
  std::mt19937 random(5);
  const auto between = [&random](double low, double high) {
    return scaled<TypeParam>(std::uniform_real_distribution<double>(low, high)(random));
  };
  for (int i = 0; i < 3000; ++i) {
    if (i % 250 == 0) {
      const auto target = between(-0.1, 0.6);
      ratio.set_target(target);
      either.set_target(target);
    }
    const Measurement<TypeParam> sample{between(0.3, 0.5), between(0.09, 0.11), Quality::good};
    const auto a = ratio.step(sample);
    const auto b = either.step(sample);
    ASSERT_TRUE(a.amplitude == b.amplitude && a.commanded_ratio == b.commanded_ratio) << i;
    ASSERT_TRUE(a.state == b.state && a.limit == b.limit && a.settling == b.settling) << i;
  }
}

TYPED_TEST(Targets, AForceIsARatioOfTheFrictionBelievedOrOfItself) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> part(0.01, 0.99);
  for (int i = 0; i < 1000; ++i) {
    const double believed = part(random);
    const double force = part(random);
    FrictionLevel<TypeParam> level(scaled<TypeParam>(believed));
    ForceTarget<TypeParam> target({true});
    EXPECT_TRUE(target.undriven(TypeParam{}));
    const TypeParam ratio = target.take(
        scaled<TypeParam>(force), [&] { return scaled<TypeParam>(believed); }, level);
    const double whole = std::max(believed, force);
    const double rounding = sizeof(TypeParam) < 4 ? 5e-3 : 1e-6;
    EXPECT_NEAR(this->real(level.force()), whole, rounding * whole);
    EXPECT_NEAR(this->real(ratio), 0.5 * force / whole, rounding);
    EXPECT_TRUE(target.driven(ratio));
    EXPECT_TRUE(target.given(ratio) == scaled<TypeParam>(force));
  }
}

TYPED_TEST(Targets, AForceOfZeroIsNoDrive) {
  FrictionLevel<TypeParam> level(scaled<TypeParam>(0.5));
  ForceTarget<TypeParam> target({true});
  for (const double force : {0.3, 0.0, 0.3, -0.2}) {
    const TypeParam ratio = target.take(
        scaled<TypeParam>(force), [] { return scaled<TypeParam>(0.5); }, level);
    EXPECT_EQ(target.undriven(ratio), !(force > 0.0));
  }
}

/// The gain of the loop is that of the friction believed, whatever the friction.
TYPED_TEST(Targets, ADeviationCountsByTheCommandOverTheTarget) {
  FrictionLevel<TypeParam> level(scaled<TypeParam>(0.5));
  ForceTarget<TypeParam> target({true});
  const TypeParam ratio = target.take(
      scaled<TypeParam>(0.2), [] { return scaled<TypeParam>(0.5); }, level);
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
