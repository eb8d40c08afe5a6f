#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmware/control/coulomb_feedforward.hpp"
#include "firmware/control/dahl_feedforward.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "scalars.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::control {
namespace {

template <class Scalar>
class FeedforwardTest : public testing::Test {
 protected:
  static DahlFeedforward<Scalar> dahl(double contact_force, double friction_force) {
    const numeric::Split<double> force = numeric::split(contact_force);
    const typename DahlFeedforward<Scalar>::Parameters parameters{
        {scaled<Scalar>(force.mantissa), force.exponent}};
    DahlFeedforward<Scalar> feedforward(parameters);
    feedforward.set_friction(FrictionLevel<Scalar>(scaled<Scalar>(friction_force)));
    return feedforward;
  }
};
TYPED_TEST_SUITE(FeedforwardTest, Scalars);

TYPED_TEST(FeedforwardTest, CoulombFollowsTheSineAtAnySpeed) {
  const CoulombFeedforward<TypeParam> feedforward({});
  const double largest = numeric::to_real(numeric::from_code<TypeParam>(INT32_MAX));
  for (double half_ratio = 0.0; half_ratio < 0.5; half_ratio += 0.013) {
    for (const double speed : {0.001, 0.1, 0.99}) {
      const double amplitude = numeric::to_real(
          feedforward.amplitude(scaled<TypeParam>(half_ratio), scaled<TypeParam>(speed)));
      const double r = std::sin(tests::pi * half_ratio);
      const double wanted = speed < r ? speed / r : largest;
      EXPECT_NEAR(amplitude, wanted, 8.0 * resolution<TypeParam>() / std::max(r, speed));
    }
  }
}

// At the amplitude that the feedforward asks for, the closed-form map gives the ratio back.
TYPED_TEST(FeedforwardTest, DahlMeetsTheClosedFormMap) {
  for (const double contact_force : {0.05, 1.0108, 20.0}) {
    for (const double friction_force : {0.01, 0.3, 0.5, 0.9}) {
      const auto feedforward = this->dahl(contact_force, friction_force);
      for (const double speed : {0.02, 0.1, 0.6, 0.99}) {
        for (const double ratio : {0.05, 0.2, 0.4, 0.7, 0.95}) {
          const double amplitude = numeric::to_real(
              feedforward.amplitude(scaled<TypeParam>(0.5 * ratio), scaled<TypeParam>(speed)));
          if (amplitude > 0.999999) {
            continue;
          }
          const double r = speed / amplitude;
          const double dahl_number = contact_force / friction_force * speed / r;
          if (dahl_number < 0.01 || dahl_number > 1000.0) {
            continue;
          }
          EXPECT_NEAR(friction::dahl_friction_ratio(r, dahl_number), ratio, 0.002)
              << "Kt X " << contact_force << " Fc " << friction_force << " speed " << speed;
        }
      }
    }
  }
}

// Table 1 at 26.72 mm/s: forces worked out apart from this program, to 1 %.
TYPED_TEST(FeedforwardTest, DahlAsksForTheKnownForcesAtTable1) {
  constexpr double omega = 376991.11843077517;
  constexpr double compliance = 1.0 / (0.02 * omega * omega - 133e6);
  constexpr double speed = 26.72e-3 / (1920.0 * compliance * omega);
  constexpr double friction_N = 0.01962;
  const auto feedforward = this->dahl(0.056e6 * 1920.0 * compliance / (2.0 * friction_N), 0.5);
  const double known[][2] = {{0.3, 818.6}, {0.5, 526.3}, {0.7, 367.9}};
  for (const auto& [ratio, force_N] : known) {
    const double amplitude = numeric::to_real(
        feedforward.amplitude(scaled<TypeParam>(0.5 * ratio), scaled<TypeParam>(speed)));
    EXPECT_NEAR(amplitude * 1920.0, force_N, 0.01 * force_N);
  }
}

TYPED_TEST(FeedforwardTest, BothGiveTheEndsOfTheMap) {
  const CoulombFeedforward<TypeParam> coulomb({});
  const auto dahl = this->dahl(1.0108, 0.5);
  const auto speed = scaled<TypeParam>(0.1);
  const auto largest = numeric::from_code<TypeParam>(INT32_MAX);
  EXPECT_EQ(coulomb.amplitude(TypeParam{}, speed), largest);
  EXPECT_EQ(dahl.amplitude(TypeParam{}, speed), largest);
  const auto whole = scaled<TypeParam>(0.5);
  EXPECT_NEAR(numeric::to_real(coulomb.amplitude(whole, speed)), 0.1, 1e-7);
  EXPECT_NEAR(numeric::to_real(dahl.amplitude(whole, speed)), 0.1, 1e-7);
}

}  // namespace
}  // namespace sonoglide::control
