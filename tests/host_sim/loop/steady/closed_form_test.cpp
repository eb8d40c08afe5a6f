#include "host_sim/loop/steady/requirement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/constants/pi.hpp"
#include "tests/host_sim/loop/steady/scenes/steady_scenes.hpp"

namespace sonoglide::steady::closed_form_test {
namespace {

using tests::pi;

// rho = (2/pi) asin(Vt/v), so v = Vt/sin(pi rho/2).
TEST(ClosedFormVibrationTest, IsTheInverseOfCoulombsArcSine) {
  for (const double ratio : {0.01, 0.1, 0.5, 0.9, 0.999}) {
    const RequiredVibration vibration = closed_form_vibration(coulomb(), 0.03, ratio);
    EXPECT_NEAR(vibration.velocity_m_per_s, 0.03 / std::sin(0.5 * pi * ratio),
                1e-12 * vibration.velocity_m_per_s);
    EXPECT_EQ(vibration.friction_ratio, ratio);
  }
}

TEST(ClosedFormVibrationTest, IsTheInverseOfTheDahlMap) {
  for (const double ratio : {0.001, 0.1, 0.5, 0.9, 0.999}) {
    const RequiredVibration vibration = closed_form_vibration(table_1(), 0.03, ratio);
    EXPECT_NEAR(closed_form_ratio(table_1(), 0.03, vibration.velocity_m_per_s), ratio, 1e-12);
  }
}

// Of every law that has a map in firmware/friction.
TEST(ClosedFormVibrationTest, IsTheInverseOfEveryMap) {
  for (const scene::Scene& scene : {iwan(), lugre(), transverse(), normal(), stribeck()}) {
    for (const double ratio : {0.4, 0.6, 0.9, 0.99}) {
      const RequiredVibration found = closed_form_vibration(scene, 0.03, ratio);
      EXPECT_EQ(found.friction_ratio, ratio) << scene::name_of(scene.friction.law);
      EXPECT_NEAR(closed_form_ratio(scene, 0.03, found.velocity_m_per_s), ratio, 1e-11)
          << scene::name_of(scene.friction.law);
    }
  }
}

// (2/pi) r/sqrt(1 + r^2) K(k) is 0.64264 at r = 0.5 and 0.83463 at r = 1.
TEST(ClosedFormVibrationTest, AcrossTheSlidingNeedsLessThanAVelocityRatioOfOne) {
  EXPECT_NEAR(closed_form_vibration(transverse(), 0.03, 0.64264).velocity_m_per_s, 0.06, 1e-5);
  EXPECT_NEAR(closed_form_vibration(transverse(), 0.03, 0.83463).velocity_m_per_s, 0.03, 1e-5);
  EXPECT_LT(closed_form_vibration(transverse(), 0.03, 0.95).velocity_m_per_s, 0.03);
}

// 1 - alpha Psi(s), alpha = 1 where the contact is about to open: 1 as s -> 0.
TEST(ClosedFormVibrationTest, NormalToTheSurfaceEndsWhereTheContactOpens) {
  const RequiredVibration lowest = closed_form_vibration(normal(), 0.03, 0.01);
  EXPECT_GT(lowest.friction_ratio, 0.01);
  EXPECT_NEAR(lowest.velocity_m_per_s, 0.2, 1e-9);
  EXPECT_EQ(closed_form_vibration(normal(), 1e-4, 0.01).friction_ratio, 0.01);
}

// A LuGre contact without a static friction of its own and without viscous friction is Dahl's.
TEST(ClosedFormVibrationTest, OfLuGreHasDahlsAsALimit) {
  scene::Scene scene = lugre();
  scene.friction.law = scene::laws::LuGre{0.1, 0.01, 0.0, 0.0};
  const double dahl = closed_form_vibration(table_1(), 0.03, 0.5).velocity_m_per_s;
  EXPECT_NEAR(closed_form_vibration(scene, 0.03, 0.5).velocity_m_per_s, dahl, 0.01 * dahl);
}

// Thomsen's averaged curve: its least over the vibration, by a fine scan.
TEST(ClosedFormVibrationTest, HasALowestRatioWhereFrictionRisesWithTheVibration) {
  double lowest = 1.0;
  for (double vibration = 0.0268; vibration < 2.0; vibration += 1e-4) {
    lowest = std::min(lowest, closed_form_ratio(stribeck(), 0.02672, vibration));
  }
  const RequiredVibration found = closed_form_vibration(stribeck(), 0.02672, 0.5 * lowest);
  EXPECT_NEAR(found.friction_ratio, lowest, 1e-6);
  EXPECT_NEAR(closed_form_ratio(stribeck(), 0.02672, found.velocity_m_per_s), lowest, 1e-6);
  const RequiredVibration above = closed_form_vibration(stribeck(), 0.02672, 1.1 * lowest);
  EXPECT_LT(above.velocity_m_per_s, found.velocity_m_per_s);
  EXPECT_NEAR(closed_form_ratio(stribeck(), 0.02672, above.velocity_m_per_s), 1.1 * lowest, 1e-12);
}

}  // namespace
}  // namespace sonoglide::steady::closed_form_test
