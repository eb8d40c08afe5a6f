#include "firmware/control/friction/learnt_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "scalars.hpp"

namespace sonoglide::control::learnt_friction_test {
namespace {

template <class Scalar>
class LearntFrictionTest : public testing::Test {
 protected:
  static LearntFriction<Scalar> learner(std::uint32_t settle, std::uint32_t average,
                                        std::uint32_t total = 0) {
    LearntFriction<Scalar> friction({settle, average,
                                     scaled<numeric::Accumulator<Scalar>>(1.0 / average), total,
                                     scaled<Scalar>(0.05)});
    friction.restart();
    return friction;
  }
  static void learn(LearntFriction<Scalar>& friction, double force, double velocity = 0.1) {
    friction.learn(scaled<Scalar>(force), scaled<Scalar>(velocity), std::abs(velocity) < 0.02);
  }
  /// What is left of a reading.
  static double tared(const LearntFriction<Scalar>& friction, double force) {
    return numeric::to_real(friction.without_offset(scaled<Scalar>(force)));
  }
  static double learnt(const LearntFriction<Scalar>& friction) {
    return numeric::to_real(friction.friction_force(scaled<Scalar>(0.9)));
  }
  /// Half a unit for each sample, once for the product and once for the sum, and the weight's own.
  static double allowance(std::uint32_t average) { return average * resolution<Scalar>(); }
};
TYPED_TEST_SUITE(LearntFrictionTest, Scalars);

TYPED_TEST(LearntFrictionTest, IsTheMean) {
  constexpr std::uint32_t count = 96;
  auto friction = this->learner(0, count);
  long double sum = 0.0L;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double force = 0.4 + 0.04 * std::sin(1.7 * i);
    sum += static_cast<long double>(force);
    this->learn(friction, force);
  }
  EXPECT_NEAR(this->learnt(friction), static_cast<double>(sum / count), this->allowance(count));
}

/// Ringing makes the friction of a period smaller, never larger.
TYPED_TEST(LearntFrictionTest, IsTheLargestReadingWhereTheMassRings) {
  for (const double least : {0.31, 0.29}) {
    auto friction = this->learner(0, 4);
    for (const double force : {0.4, least, 0.36, 0.38}) {
      this->learn(friction, force);
    }
    const double mean = (0.4 + least + 0.36 + 0.38) / 4.0;
    EXPECT_NEAR(this->learnt(friction), least < 0.3 ? 0.4 : mean, this->allowance(4)) << least;
  }
}

TYPED_TEST(LearntFrictionTest, PassesOverTheSettlingPart) {
  auto friction = this->learner(7, 4);
  for (int i = 0; i < 7; ++i) {
    this->learn(friction, -0.9);
  }
  EXPECT_EQ(this->learnt(friction), 0.0);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(friction.learning());
    this->learn(friction, 0.25);
  }
  EXPECT_EQ(this->learnt(friction), 0.25);
}

TYPED_TEST(LearntFrictionTest, LearnsForExactlyTheStatedPeriods) {
  auto friction = this->learner(5, 3);
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(friction.learning()) << "after " << i;
    this->learn(friction, 0.5);
  }
  EXPECT_FALSE(friction.learning());
}

TYPED_TEST(LearntFrictionTest, StaysWithinItsRoundingOverALongCalibration) {
  constexpr std::uint32_t count = 6000;
  auto friction = this->learner(6000, count);
  for (std::uint32_t i = 0; i < 2 * count; ++i) {
    this->learn(friction, 0.7);
  }
  EXPECT_NEAR(this->learnt(friction), 0.7, this->allowance(count));
}

TYPED_TEST(LearntFrictionTest, ARestartForgets) {
  auto friction = this->learner(2, 2);
  for (int i = 0; i < 4; ++i) {
    this->learn(friction, 0.9);
  }
  friction.restart();
  EXPECT_TRUE(friction.learning());
  for (int i = 0; i < 4; ++i) {
    this->learn(friction, 0.125);
  }
  EXPECT_FALSE(friction.learning());
  EXPECT_EQ(this->learnt(friction), 0.125);
}

TYPED_TEST(LearntFrictionTest, IsNegativeWhereTheSensorIsWiredBackwards) {
  auto friction = this->learner(2, 4);
  for (int i = 0; i < 6; ++i) {
    this->learn(friction, 0.5, -0.1);
  }
  EXPECT_FALSE(friction.learning());
  EXPECT_EQ(this->learnt(friction), -0.5);
}

TYPED_TEST(LearntFrictionTest, GoesOnForTheStatedTotal) {
  auto friction = this->learner(1, 2, 10);
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(friction.learning()) << "after " << i;
    this->learn(friction,
                i < 3 ? 0.25 : 0.75);  // what comes after the mean is known does not count
  }
  EXPECT_FALSE(friction.learning());
  EXPECT_EQ(this->learnt(friction), 0.25);
}

TYPED_TEST(LearntFrictionTest, ARestartCountsAndTaresAnew) {
  auto friction = this->learner(1, 2, 10);
  for (const double offset : {0.125, -0.125}) {
    friction.restart();
    for (int i = 0; i < 10; ++i) {
      ASSERT_TRUE(friction.learning()) << "after " << i << ", offset " << offset;
      this->learn(friction, i < 4 ? offset : offset + 0.5, i < 4 ? 0.0 : 0.1);
    }
    EXPECT_FALSE(friction.learning());
    EXPECT_EQ(this->learnt(friction), 0.5);
    EXPECT_EQ(this->tared(friction, 0.375), 0.375 - offset);
  }
}

TYPED_TEST(LearntFrictionTest, TellsAnOffsetFromFrictionByAReversal) {
  auto friction = this->learner(2, 4, 12);
  for (int i = 0; i < 12; ++i) {
    this->learn(friction, i < 6 ? 0.5 + 0.125 : -0.5 + 0.125, i < 6 ? 0.1 : -0.1);
  }
  ASSERT_FALSE(friction.learning());
  EXPECT_EQ(this->learnt(friction), 0.5);
  EXPECT_EQ(this->tared(friction, 0.375), 0.25);
}

TYPED_TEST(LearntFrictionTest, TellsAnOffsetFromFrictionByStandingStillFirst) {
  for (const double velocity : {0.1, -0.1}) {
    auto friction = this->learner(2, 4);
    for (int i = 0; i < 50; ++i) {
      this->learn(friction, 0.125, 0.0);
    }
    for (int i = 0; i < 6; ++i) {
      this->learn(friction, (velocity < 0.0 ? -0.5 : 0.5) + 0.125, velocity);
    }
    ASSERT_FALSE(friction.learning());
    EXPECT_EQ(this->learnt(friction), 0.5);
    EXPECT_EQ(this->tared(friction, 0.375), 0.25);
  }
}

// A contact that has slid holds on to its force.
TYPED_TEST(LearntFrictionTest, TakesNoOffsetFromAStandstillAfterASliding) {
  auto friction = this->learner(2, 4);
  this->learn(friction, 0.5);
  for (int i = 0; i < 50; ++i) {
    this->learn(friction, 0.375, 0.0);
  }
  for (int i = 0; i < 6; ++i) {
    this->learn(friction, 0.5);
  }
  EXPECT_EQ(this->learnt(friction), 0.5);
  EXPECT_EQ(this->tared(friction, 0.25), 0.25);
}

TYPED_TEST(LearntFrictionTest, TrustNeverLearns) {
  TrustedFriction<TypeParam> friction({});
  EXPECT_FALSE(friction.learning());
  friction.learn(scaled<TypeParam>(0.3), scaled<TypeParam>(0.1), false);
  EXPECT_EQ(numeric::to_real(friction.friction_force(scaled<TypeParam>(0.75))), 0.75);
}

TYPED_TEST(LearntFrictionTest, IsBelievedAsConfiguredUntilItIsLearnt) {
  auto friction = this->learner(1, 2);
  const auto configured = scaled<TypeParam>(0.75);
  const auto believed = friction.believed(configured);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(believed(), configured);
    this->learn(friction, 0.25);
  }
  EXPECT_EQ(numeric::to_real(believed()), 0.25);
}

TYPED_TEST(LearntFrictionTest, ADirectionThatIsKnownStaysAsItIs) {
  auto friction = this->learner(1, 2, 20);
  for (int i = 0; i < 10; ++i) {
    this->learn(friction, i < 3 ? 0.25 : 0.75);
  }
  this->learn(friction, -0.75, -0.1);
  for (int i = 0; i < 9; ++i) {
    this->learn(friction, 0.75);
  }
  EXPECT_FALSE(friction.learning());
  EXPECT_EQ(this->learnt(friction), 0.25);
}

}  // namespace
}  // namespace sonoglide::control::learnt_friction_test
