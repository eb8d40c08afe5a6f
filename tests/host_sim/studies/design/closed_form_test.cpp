#include "host_sim/studies/design/closed_form.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "design_scenes.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::design::closed_form_test {
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
}  // namespace sonoglide::design::closed_form_test
