#include "firmware/control/feedback/settling_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "scalars.hpp"

namespace sonoglide::control::settling_watch_test {
namespace {

template <class Scalar>
class SettlingWatchTest : public testing::Test {
 protected:
  static constexpr double band = 0.01;
  static constexpr std::uint16_t patience = 50;

  SettlingWatchTest() { watch_.restart(); }

  /// Ratios themselves, not on base 2.
  void judge(double target, double measured, double commanded, bool clamped = false) {
    watch_.judge(scaled<Scalar>(0.5 * target), scaled<Scalar>(0.5 * measured),
                 scaled<Scalar>(0.5 * commanded), clamped);
  }
  void judge_for(int periods, double target, double measured, double commanded) {
    for (int i = 0; i < periods; ++i) {
      judge(target, measured, commanded);
    }
  }

  SettlingWatch<Scalar> watch_{{scaled<Scalar>(0.5 * band), patience, scaled<Scalar>(1.0 / 1.25)}};
};
TYPED_TEST_SUITE(SettlingWatchTest, Scalars);

TYPED_TEST(SettlingWatchTest, SaysNothingBeforeAPeriodInsideTheBand) {
  EXPECT_EQ(this->watch_.settling(), Settling::pending);
  EXPECT_EQ(this->watch_.limit_named(), Limit::none);
  this->judge(0.4, 0.405, 0.4);
  EXPECT_EQ(this->watch_.settling(), Settling::settled);
  EXPECT_EQ(this->watch_.limit_named(), Limit::none);
}

TYPED_TEST(SettlingWatchTest, NamesARatioThatStaysAwayAfterTheStatedPeriods) {
  this->judge(0.4, 0.4, 0.4);
  for (int i = 1; i < this->patience; ++i) {
    this->judge(0.4, 0.45, 0.4);
    ASSERT_EQ(this->watch_.limit_named(), Limit::none) << i;
  }
  this->judge(0.4, 0.45, 0.4);
  EXPECT_EQ(this->watch_.limit_named(), Limit::not_settling);
  EXPECT_EQ(this->watch_.settling(), Settling::offset);
}

/// 4 up for each period outside, 1 down for each one inside: doubted above 8.
TYPED_TEST(SettlingWatchTest, DoubtsWhatIsKnownFromTheThirdPeriodOutside) {
  this->judge(0.4, 0.4, 0.4);
  this->judge_for(2, 0.4, 0.45, 0.4);
  EXPECT_FALSE(this->watch_.doubts());
  this->judge(0.4, 0.45, 0.4);
  EXPECT_TRUE(this->watch_.doubts());
  this->judge_for(4, 0.4, 0.4, 0.4);
  EXPECT_FALSE(this->watch_.doubts());
  this->judge_for(60, 0.4, 0.4, 0.2);
  EXPECT_EQ(this->watch_.limit_named(), Limit::mismatch);
  EXPECT_TRUE(this->watch_.doubts());
}

TYPED_TEST(SettlingWatchTest, KnowsWhy) {
  for (int i = 0; i < 100; ++i) {
    this->judge(0.4, 0.4 + 0.05 * std::sin(1.36 * i), 0.4);
  }
  EXPECT_EQ(this->watch_.settling(), Settling::ringing);
  this->watch_.restart();
  for (int i = 0; i < 100; ++i) {
    this->judge(0.4, 0.45, 0.0, i == 40);
  }
  EXPECT_EQ(this->watch_.settling(), Settling::clamped);
}

/// A sinusoid is outside for (2/pi) acos(band / amplitude) of the time.
TYPED_TEST(SettlingWatchTest, FindsASwingThatPassesThroughTheBand) {
  for (const double angle : {0.05, 1.36, 2.7}) {
    this->watch_.restart();
    for (int i = 0; i < 5000; ++i) {
      this->judge(0.4, 0.4 + 0.012 * std::sin(angle * i), 0.4);
    }
    EXPECT_EQ(this->watch_.limit_named(), Limit::not_settling) << angle;
    for (int i = 0; i < 5000; ++i) {
      this->judge(0.4, 0.4 + 0.0098 * std::sin(angle * i), 0.4);
    }
    EXPECT_EQ(this->watch_.limit_named(), Limit::none) << angle;
  }
}

TYPED_TEST(SettlingWatchTest, AFewPeriodsOutsideAreForgottenByFourTimesAsManyInside) {
  this->judge(0.4, 0.4, 0.4);
  this->judge_for(5, 0.6, 0.4, 0.6);
  this->judge_for(19, 0.6, 0.6, 0.6);
  EXPECT_EQ(this->watch_.settling(), Settling::pending);
  this->judge(0.6, 0.6, 0.6);
  EXPECT_EQ(this->watch_.settling(), Settling::settled);
}

TYPED_TEST(SettlingWatchTest, ALimitEndsAfter129PeriodsInside) {
  this->judge_for(1000, 0.4, 0.5, 0.4);
  this->judge_for(128, 0.4, 0.4, 0.4);
  EXPECT_EQ(this->watch_.limit_named(), Limit::not_settling);
  this->judge(0.4, 0.4, 0.4);
  EXPECT_EQ(this->watch_.limit_named(), Limit::none);
  EXPECT_EQ(this->watch_.settling(), Settling::settled);
}

TYPED_TEST(SettlingWatchTest, NamesAFrictionThatIsNotTheBelievedOne) {
  this->judge_for(20, 0.4, 0.4, 0.49);
  EXPECT_EQ(this->watch_.limit_named(), Limit::none);
  this->judge_for(15, 0.4, 0.4, 0.51);
  EXPECT_EQ(this->watch_.limit_named(), Limit::none);
  this->judge(0.4, 0.4, 0.51);
  EXPECT_EQ(this->watch_.limit_named(), Limit::mismatch);
  EXPECT_EQ(this->watch_.settling(), Settling::settled);
  this->judge(0.4, 0.4, 0.33);
  EXPECT_EQ(this->watch_.limit_named(), Limit::none);
  this->judge_for(16, 0.4, 0.4, 0.31);
  EXPECT_EQ(this->watch_.limit_named(), Limit::mismatch);
  this->watch_.forget_disagreement();
  EXPECT_EQ(this->watch_.limit_named(), Limit::none);
}

TYPED_TEST(SettlingWatchTest, TakesNoNoiseForAnotherFriction) {
  for (int i = 0; i < 500; ++i) {
    this->judge(0.4, 0.4, i % 3 == 0 ? 0.2 : i % 3 == 1 ? 0.6 : 0.4);
    this->judge(0.4, 0.4, 0.4);
    ASSERT_EQ(this->watch_.limit_named(), Limit::none) << i;
  }
}

TYPED_TEST(SettlingWatchTest, NamesNoMismatchBeforeItHasSettled) {
  this->judge_for(3, 0.4, 0.3, 0.2);
  EXPECT_EQ(this->watch_.limit_named(), Limit::none);
}

/// Of a map in which a ratio ρ needs the velocity (1 - ρ)/2: those of ratios from 4/5 to 5/4 of the target agree.
TYPED_TEST(SettlingWatchTest, ImpliesTheTargetByAVelocityThatAgrees) {
  const auto implied = [&](double target, double of_ratio) {
    const auto velocity_of = [](TypeParam half_ratio) {
      return scaled<TypeParam>(0.5) - half_ratio;
    };
    const auto half_target = scaled<TypeParam>(0.5 * target);
    return 2.0 * numeric::to_real(this->watch_.implied_ratio(
                     half_target, velocity_of(half_target),
                     velocity_of(scaled<TypeParam>(0.5 * of_ratio)), velocity_of));
  };
  for (const double agreeing : {0.33, 0.4, 0.49}) {
    EXPECT_NEAR(implied(0.4, agreeing), 0.4, 1e-6) << agreeing;
  }
  EXPECT_EQ(implied(0.4, 0.31), 0.0);
  EXPECT_EQ(implied(0.4, 0.51), 0.0);
  EXPECT_NEAR(implied(0.9, 1.0), 0.9, 1e-6);  // 5/4 of it is above 1
}

/// However the target is divided by 4/5, no ratio above 1 is looked up.
TYPED_TEST(SettlingWatchTest, LooksUpNoRatioAbove1) {
  const auto whole = scaled<TypeParam>(0.5);
  for (int step = 0; step < 4096; ++step) {
    const auto half_target = scaled<TypeParam>(0.4 - 1e-6 * step);
    this->watch_.implied_ratio(half_target, whole, TypeParam{}, [&](TypeParam half_ratio) {
      EXPECT_FALSE(whole < half_ratio) << step;
      return TypeParam{};
    });
  }
}

}  // namespace
}  // namespace sonoglide::control::settling_watch_test
