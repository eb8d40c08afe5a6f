/// Derivatives of the simulated ratio against closed forms and dimensional analysis.

#include "host_sim/studies/design/study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "host_sim/loop/steady/requirement.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/host_sim/loop/steady/scenes/steady_scenes.hpp"

namespace sonoglide::design::sensitivity_test {
namespace {

using steady::coulomb;
using steady::resonant;
using steady::Table1;
using steady::table_1;

using tests::pi;

using BySymbol = std::map<std::string, double>;

scene::Scene at_ratio(const scene::Scene& scene, double ratio) {
  return steady::steady_scene(scene, 0.02672,
                              steady::require_ratio(scene, 0.02672, ratio).motion.drive_force_N);
}

/// d ln rho / d ln p; 0 of a parameter that the scene has not.
BySymbol logarithmic(const scene::Scene& steady) {
  BySymbol values;
  for (const Sensitivity& each : sensitivities(steady)) {
    values[each.parameter.symbol] = each.logarithmic;
  }
  return values;
}

// With r = Vt/v and v = Fe w/(m w^2 - Ks): d ln rho/d ln r = r/(sqrt(1 - r^2) asin r).
TEST(SensitivityTest, OfCoulombIsTheDerivativeOfTheArcSine) {
  const double ratio = 0.4;
  const double r = std::sin(0.5 * pi * ratio);
  const double by_r = r / (std::sqrt(1.0 - r * r) * 0.5 * pi * ratio);
  const double spring = Table1::stiffness_N_per_m * Table1::compliance_m_per_N;
  BySymbol found = logarithmic(at_ratio(coulomb(), ratio));
  EXPECT_NEAR(found["Vt"], by_r, 2e-3 * by_r);
  EXPECT_NEAR(found["Fe"], -by_r, 2e-3 * by_r);
  EXPECT_NEAR(found["m"], by_r * (1.0 + spring), 2e-3 * by_r);
  EXPECT_NEAR(found["Ks"], -by_r * spring, 2e-3 * by_r);
  EXPECT_NEAR(found["f"], by_r * (1.0 + 2.0 * spring), 2e-3 * by_r);
  // Friction as such has no say but where it bends the motion.
  EXPECT_NEAR(found["mu"], 0.0, 1e-3);
  EXPECT_EQ(found.count("Kt"), 0U);
  EXPECT_EQ(found.count("c"), 0U);
}

// A pure number does not change with the units of mass, length and time: the sums of the
// derivatives, weighted by each dimension, vanish. Heavy friction and damping included.
TEST(SensitivityTest, ObeysDimensionalAnalysis) {
  for (const scene::Scene& scene : {table_1(), coulomb(), resonant()}) {
    BySymbol d = logarithmic(at_ratio(scene, 0.5));
    const double mass = d["m"] + d["Ks"] + d["c"] + d["Kt"] + d["N"] + d["Fe"];
    const double length = d["N"] + d["Fe"] + d["Vt"];
    const double time = -2.0 * (d["Ks"] + d["Kt"] + d["N"] + d["Fe"]) - d["c"] - d["f"] - d["Vt"];
    EXPECT_NEAR(mass, 0.0, 2e-5);
    EXPECT_NEAR(length, 0.0, 2e-5);
    EXPECT_NEAR(time, 0.0, 5e-5);
    EXPECT_NEAR(d["mu"], d["N"], 1e-6);
  }
}

// Far below resonance, where the mass alone counts, the ratio hangs on Fe/m and not on either.
TEST(SensitivityTest, InTheMassControlledRegimeForceAndMassCancel) {
  scene::Scene scene = table_1();
  scene.plant.stiffness_N_per_m *= 0.01;
  BySymbol d = logarithmic(at_ratio(scene, 0.5));
  EXPECT_NEAR(d["m"], -d["Fe"], 1e-3);
  EXPECT_NEAR(d["Ks"], 0.0, 1e-3);
}

TEST(SensitivityTest, ChangesAreThoseOfTheSimulation) {
  const scene::Scene steady = at_ratio(table_1(), 0.5);
  scene::Scene faster = steady;
  faster.sliding.profile[0].velocity_m_per_s *= 1.01;
  const Sensitivity speed = sensitivities(steady).back();
  EXPECT_STREQ(speed.parameter.key, "sliding.velocity_m_per_s");
  EXPECT_DOUBLE_EQ(speed.change_by_more,
                   steady::friction_ratio(faster) - steady::friction_ratio(steady));
  EXPECT_NEAR(speed.change_by_more, 0.01 * 0.5 * speed.logarithmic, 1e-4);
  EXPECT_LT(speed.change_by_less, 0.0);
  EXPECT_GE(speed.largest_change(), speed.change_by_more);
}

}  // namespace
}  // namespace sonoglide::design::sensitivity_test
