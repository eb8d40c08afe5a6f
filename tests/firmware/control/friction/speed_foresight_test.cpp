#include "firmware/control/friction/speed_foresight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scalars.hpp"
#include "scripted_run.hpp"

namespace sonoglide::control::speed_foresight_test {
namespace {

constexpr double lead_periods = 2.5;

template <class Scalar>
class SpeedForesightTest : public testing::Test {
 protected:
  double speed(double velocity) {
    return numeric::to_real(foresight_.speed(scaled<Scalar>(velocity)));
  }
  /// Six roundings of a change, and of the lead by them.
  static double allowance() { return 64.0 * resolution<Scalar>(); }

  SpeedForesight<Scalar> foresight_{scaled<Scalar>(lead_periods / 64.0)};
};
TYPED_TEST_SUITE(SpeedForesightTest, Scalars);

TYPED_TEST(SpeedForesightTest, FollowsARamp) {
  for (const double slope : {0.003, -0.003}) {
    this->foresight_.restart();
    for (int i = 0; i < 40; ++i) {
      const double velocity = 0.2 + slope * i;
      const double lead = i < 1 ? 0.0 : lead_periods * slope;
      EXPECT_NEAR(this->speed(velocity), velocity + lead, this->allowance()) << i;
    }
  }
}

TYPED_TEST(SpeedForesightTest, HardlyCarriesAStepOn) {
  for (int i = 0; i < 20; ++i) {
    const double velocity = i < 10 ? 0.1 : 0.3;
    EXPECT_NEAR(this->speed(velocity), i == 10 ? 1.125 * velocity : velocity, this->allowance())
        << i;
  }
}

TYPED_TEST(SpeedForesightTest, ASingleWrongSampleIsHardlyCarriedOn) {
  for (const double wrong : {0.0, 0.05, 0.25, -0.1}) {
    this->foresight_.restart();
    for (int i = 0; i < 30; ++i) {
      const double velocity = i == 15 ? wrong : 0.1;
      EXPECT_LE(this->speed(velocity), 1.125 * std::abs(velocity) + this->allowance())
          << wrong << ' ' << i;
    }
  }
}

TYPED_TEST(SpeedForesightTest, NeverTurnsTheSlidingByExtrapolation) {
  this->speed(0.09);
  this->speed(0.05);
  EXPECT_EQ(this->speed(0.01), 0.0);
  this->foresight_.restart();
  this->speed(-0.09);
  this->speed(-0.05);
  EXPECT_EQ(this->speed(-0.01), 0.0);
}

TYPED_TEST(SpeedForesightTest, NeverForeseesMoreThanTheSpeedWhileItFalls) {
  Sequence sequence(7);
  for (int run = 0; run < 300; ++run) {
    this->foresight_.restart();
    const double sign = sequence.next() < 0.5 ? -1.0 : 1.0;
    double speed = 0.8 * sequence.next();
    while (speed > 0.0) {
      ASSERT_LE(this->speed(sign * speed), speed + this->allowance());
      speed -= 0.1 * sequence.next();
    }
    ASSERT_EQ(this->speed(0.0), 0.0);
  }
}

TYPED_TEST(SpeedForesightTest, AVelocityThatStaysIsTheForeseenOne) {
  this->speed(0.1);
  this->speed(0.15);
  const double once = this->speed(0.15);
  EXPECT_EQ(once, numeric::to_real(scaled<TypeParam>(0.15)));
  EXPECT_EQ(this->speed(0.15), once);
  EXPECT_NEAR(this->speed(0.2), 1.125 * 0.2, this->allowance());  // as a step
}

TYPED_TEST(SpeedForesightTest, ARestartForgetsTheSlope) {
  this->speed(0.1);
  this->speed(0.15);
  this->foresight_.restart();
  EXPECT_NEAR(this->speed(0.2), 0.2, this->allowance());
}

}  // namespace
}  // namespace sonoglide::control::speed_foresight_test
