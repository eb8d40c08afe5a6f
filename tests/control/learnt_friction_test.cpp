#include "firmware/control/learnt_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "firmware/control/trusted_friction.hpp"
#include "scalars.hpp"

namespace sonoglide::control {
namespace {

template <class Scalar>
class LearntFrictionTest : public testing::Test {
 protected:
  static LearntFriction<Scalar> learner(std::uint32_t settle, std::uint32_t average) {
    return LearntFriction<Scalar>({settle, average, scaled<Scalar>(1.0 / average)});
  }
  static double learnt(const LearntFriction<Scalar>& friction) {
    return numeric::to_real(friction.friction_force(scaled<Scalar>(0.9)));
  }
  /// Half a unit for each sample, once for the product and once for the sum, and the weight's own.
  static double allowance(std::uint32_t average) { return average * resolution<Scalar>(); }
};
TYPED_TEST_SUITE(LearntFrictionTest, Scalars);

TYPED_TEST(LearntFrictionTest, IsTheMeanMagnitude) {
  constexpr std::uint32_t count = 96;
  auto friction = this->learner(0, count);
  long double sum = 0.0L;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double force = 0.4 + 0.3 * std::sin(1.7 * i);
    sum += static_cast<long double>(force);
    friction.learn(scaled<TypeParam>(i % 3 == 0 ? -force : force));
  }
  EXPECT_NEAR(this->learnt(friction), static_cast<double>(sum / count), this->allowance(count));
}

TYPED_TEST(LearntFrictionTest, PassesOverTheSettlingPart) {
  auto friction = this->learner(7, 4);
  for (int i = 0; i < 7; ++i) {
    friction.learn(scaled<TypeParam>(-0.9));
  }
  EXPECT_EQ(this->learnt(friction), 0.0);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(friction.learning());
    friction.learn(scaled<TypeParam>(0.25));
  }
  EXPECT_EQ(this->learnt(friction), 0.25);
}

TYPED_TEST(LearntFrictionTest, LearnsForExactlyTheStatedPeriods) {
  auto friction = this->learner(5, 3);
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(friction.learning()) << "after " << i;
    friction.learn(scaled<TypeParam>(0.5));
  }
  EXPECT_FALSE(friction.learning());
}

TYPED_TEST(LearntFrictionTest, StaysWithinItsRoundingOverALongCalibration) {
  constexpr std::uint32_t count = 6000;
  auto friction = this->learner(6000, count);
  for (std::uint32_t i = 0; i < 2 * count; ++i) {
    friction.learn(scaled<TypeParam>(0.7));
  }
  EXPECT_NEAR(this->learnt(friction), 0.7, this->allowance(count));
}

TYPED_TEST(LearntFrictionTest, ARestartForgets) {
  auto friction = this->learner(2, 2);
  for (int i = 0; i < 4; ++i) {
    friction.learn(scaled<TypeParam>(0.9));
  }
  friction.restart();
  EXPECT_TRUE(friction.learning());
  for (int i = 0; i < 4; ++i) {
    friction.learn(scaled<TypeParam>(0.125));
  }
  EXPECT_FALSE(friction.learning());
  EXPECT_EQ(this->learnt(friction), 0.125);
}

TYPED_TEST(LearntFrictionTest, TrustNeverLearns) {
  TrustedFriction<TypeParam> friction({});
  EXPECT_FALSE(friction.learning());
  friction.learn(scaled<TypeParam>(0.3));
  EXPECT_EQ(numeric::to_real(friction.friction_force(scaled<TypeParam>(0.75))), 0.75);
}

}  // namespace
}  // namespace sonoglide::control
