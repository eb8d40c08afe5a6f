#include "host_sim/loop/plant/energy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::loop::energy_test {
namespace {

using scene::Scene;
using tests::carrier_Hz;
using tests::on_steady_orbit;
using tests::period_s;
using tests::pi;
using tests::table_1;
using tests::vibration_velocity_m_per_s;

PowerRatios window_ratios(const Scene& scene) {
  return power_ratios(run(scene).window, scene.friction.limit_N(), scene.friction.sign_convention,
                      period_s);
}

struct Case {
  std::string name;
  void (*vary)(Scene&);
};

std::ostream& operator<<(std::ostream& stream, const Case& varied) {
  return stream << varied.name;
}

void into_coulomb(Scene& scene) {
  scene.friction.law = scene::laws::Coulomb{};
  scene.friction.contact_stiffness_N_per_m = 0.0;
}

const Case cases[] = {
    {"table_1", [](Scene&) {}},
    {"steady_orbit", [](Scene& scene) { scene = on_steady_orbit(scene); }},
    {"damped", [](Scene& scene) { scene.plant.damping_N_s_per_m = 200.0; }},
    {"overdamped", [](Scene& scene) { scene.plant.damping_N_s_per_m = 5000.0; }},
    {"as_printed",
     [](Scene& scene) { scene.friction.sign_convention = scene::SignConvention::as_printed; }},
    {"as_printed_damped_ramp",
     [](Scene& scene) {
       scene.friction.sign_convention = scene::SignConvention::as_printed;
       scene.plant.damping_N_s_per_m = 30.0;
       scene.sliding.profile = {{0.0, 0.05}, {1.2e-3, -0.05}};
     }},
    {"coulomb", into_coulomb},
    {"coulomb_heavy",
     [](Scene& scene) {
       into_coulomb(scene);
       scene.friction.normal_force_N = 1000.0;
     }},
    {"none",
     [](Scene& scene) {
       scene.friction = {};
       scene.plant.damping_N_s_per_m = 50.0;
     }},
    {"stiff_contact", [](Scene& scene) { scene.friction.contact_stiffness_N_per_m = 1e9; }},
    {"heavy_friction",
     [](Scene& scene) {
       scene.friction.contact_stiffness_N_per_m = 1e9;
       scene.friction.normal_force_N = 2000.0;
     }},
    {"ramp_through_zero",
     [](Scene& scene) {
       scene.friction.normal_force_N = 50.0;
       scene.sliding.profile = {{0.0, 0.03}, {0.7e-3, 0.03}, {1.5e-3, -0.03}};
     }},
    {"resonance",
     [](Scene& scene) {
       scene.plant.stiffness_N_per_m = scene.plant.mass_kg * std::pow(2.0 * pi * carrier_Hz, 2);
     }},
    {"damped_resonance",
     [](Scene& scene) {
       scene.plant.stiffness_N_per_m = scene.plant.mass_kg * std::pow(2.0 * pi * carrier_Hz, 2);
       scene.plant.damping_N_s_per_m = 100.0;
     }},
    {"no_spring", [](Scene& scene) { scene.plant.stiffness_N_per_m = 0.0; }},
    {"no_drive",
     [](Scene& scene) {
       scene.drive.reset();
       scene.plant.initial_displacement_m = 1e-6;
       scene.friction.normal_force_N = 300.0;
     }},
};

class EnergyIdentityTest : public testing::TestWithParam<Case> {};

TEST_P(EnergyIdentityTest, HoldsToNineDigits) {
  Scene scene = table_1();
  scene.solver.tolerance = 1e-12;
  GetParam().vary(scene);
  EXPECT_LE(window_ratios(scene).balance_residual, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EnergyIdentityTest, testing::ValuesIn(cases),
                         [](const auto& varied) { return varied.param.name; });

TEST(EnergyTest, CoulombDissipatesByItsClosedForm) {
  for (const double zeta : {0.1, 0.5, 0.9}) {
    Scene scene = on_steady_orbit(table_1());
    into_coulomb(scene);
    scene.sliding.profile = {{0.0, zeta * vibration_velocity_m_per_s(scene.plant, 384.0)}};
    const PowerRatios ratios = window_ratios(scene);
    const double arc = std::asin(zeta);
    const double dissipation = 2.0 / pi * (arc + std::sqrt(1.0 - zeta * zeta) / zeta);
    // Friction is 5e-5 of the drive: so much the motion differs from the prescribed one.
    EXPECT_NEAR(ratios.friction_ratio, 2.0 / pi * arc, 1e-3) << zeta;
    EXPECT_NEAR(ratios.dissipation_ratio / dissipation, 1.0, 1e-3) << zeta;
  }
}

TEST(EnergyTest, DissipationIsPullPlusDriveInTheSteadyState) {
  const Scene scene = on_steady_orbit(table_1());
  const RunResult result = run(scene);
  const PowerRatios ratios = window_ratios(scene);
  const double stored = (result.window.stored_end_J - result.window.stored_begin_J) /
                        (scene.friction.limit_N() * result.window.sliding_distance_m);
  EXPECT_NEAR(ratios.dissipation_ratio, ratios.friction_ratio + ratios.drive_input_ratio - stored,
              1e-6);
}

TEST(EnergyTest, ThePapersBalanceIsNone) {
  const PowerRatios ratios = window_ratios(on_steady_orbit(table_1()));
  EXPECT_NEAR(ratios.dissipation_as_printed, -1700.0, 20.0);
  EXPECT_GT(ratios.dissipation_ratio, 0.5);
  EXPECT_LT(ratios.dissipation_ratio, 1.0);
}

TEST(EnergyTest, RatiosAreUndefinedWithoutFrictionOrSliding) {
  Scene frictionless = table_1();
  frictionless.friction = {};
  EXPECT_TRUE(std::isnan(window_ratios(frictionless).friction_ratio));
  EXPECT_TRUE(std::isnan(window_ratios(frictionless).dissipation_ratio));
  Scene standing = table_1();
  standing.sliding.profile = {{0.0, 0.0}};
  EXPECT_TRUE(std::isnan(window_ratios(standing).dissipation_ratio));
  EXPECT_TRUE(std::isnan(window_ratios(standing).drive_input_ratio));
  EXPECT_TRUE(std::isfinite(window_ratios(standing).friction_ratio));
}

TEST(EnergyTest, FrictionRatioHasTheSameSignBothWays) {
  Scene scene = table_1();
  const double forward = window_ratios(scene).friction_ratio;
  scene.sliding.profile[0].velocity_m_per_s *= -1.0;
  const double backward = window_ratios(scene).friction_ratio;
  EXPECT_GT(forward, 0.6);
  EXPECT_NEAR(backward, forward, 0.02);
}

EnergyBalance stretch(double scale) {
  EnergyBalance energy;
  energy.duration_s = scale;
  energy.sliding_distance_m = 2.0 * scale;
  energy.friction_impulse_N_s = 3.0 * scale;
  energy.resistance_impulse_N_s = 4.0 * scale;
  energy.undriven_s = 13.0 * scale;
  energy.limit_distance_m = 14.0 * scale;
  energy.friction_work_J = 5.0 * scale;
  energy.pull_work_J = 6.0 * scale;
  energy.drive_work_J = 7.0 * scale;
  energy.damping_work_J = 8.0 * scale;
  energy.stored_begin_J = 9.0 * scale;
  energy.stored_end_J = 10.0 * scale;
  energy.stored_integral_J_s = 11.0 * scale;
  energy.momentum_integral_J_s = 12.0 * scale;
  return energy;
}

TEST(EnergyBalanceTest, StretchesAddUpAndKeepTheFirstAndLastStore) {
  EnergyBalance total;
  total.append(stretch(1.0));
  total.append(stretch(2.0));
  EXPECT_EQ(total.duration_s, 3.0);
  EXPECT_EQ(total.sliding_distance_m, 6.0);
  EXPECT_EQ(total.friction_impulse_N_s, 9.0);
  EXPECT_EQ(total.resistance_impulse_N_s, 12.0);
  EXPECT_EQ(total.undriven_s, 39.0);
  EXPECT_EQ(total.limit_distance_m, 42.0);
  EXPECT_EQ(total.friction_work_J, 15.0);
  EXPECT_EQ(total.pull_work_J, 18.0);
  EXPECT_EQ(total.drive_work_J, 21.0);
  EXPECT_EQ(total.damping_work_J, 24.0);
  EXPECT_EQ(total.stored_begin_J, 9.0);
  EXPECT_EQ(total.stored_end_J, 20.0);
  EXPECT_EQ(total.stored_integral_J_s, 33.0);
  EXPECT_EQ(total.momentum_integral_J_s, 36.0);
}

TEST(EnergyBalanceTest, ResidualTakesTheConventionsSign) {
  EnergyBalance energy;
  energy.duration_s = 1.0;
  energy.pull_work_J = 10.0;
  energy.drive_work_J = 4.0;
  energy.damping_work_J = 1.0;
  energy.stored_end_J = 1.0;
  energy.friction_work_J = 12.0;  // 10 + (4 - 1 - 1)
  const auto residual = [&energy](scene::SignConvention convention) {
    return power_ratios(energy, 1.0, convention, 1.0).balance_residual;
  };
  EXPECT_EQ(residual(scene::SignConvention::dissipative), 0.0);
  EXPECT_DOUBLE_EQ(residual(scene::SignConvention::as_printed), 4.0 / 12.0);
  energy.friction_work_J = 8.0;  // 10 - (4 - 1 - 1)
  EXPECT_EQ(residual(scene::SignConvention::as_printed), 0.0);
  EXPECT_DOUBLE_EQ(residual(scene::SignConvention::dissipative), 4.0 / 10.0);
}

/// What would be relative to a rounding alone is relative to what is stored, or is not defined.
TEST(EnergyBalanceTest, ResidualHasAScaleThatExists) {
  EnergyBalance energy;
  energy.duration_s = 1.0;
  const auto residual = [&energy] { return power_ratios(table_1(), energy).balance_residual; };
  EXPECT_TRUE(std::isnan(residual())) << "nothing moves";
  energy.drive_work_J = 1e-20;
  energy.stored_end_J = 1e-25;
  EXPECT_TRUE(std::isnan(residual())) << "a contact at breakaway";
  energy.drive_work_J = 0.0;
  energy.stored_begin_J = 2.0;
  energy.stored_end_J = 2.0 + 1e-12;
  EXPECT_NEAR(residual(), 0.5e-12, 1e-15) << "nothing is passed on";
  energy.stored_end_J = 3.0;
  EXPECT_DOUBLE_EQ(residual(), 1.0) << "energy out of nothing";
}

TEST(EnergyTest, ResidualOfAnOscillatorAloneIsThatOfItsEnergy) {
  Scene scene = table_1();
  scene.friction.law = scene::laws::None{};
  scene.friction.normal_force_N = 0.0;
  scene.drive->force_amplitude_N = 0.0;
  scene.plant.initial_displacement_m = 1e-6;
  EXPECT_LE(window_ratios(scene).balance_residual, 1e-9);
}

/// The paper's term with the momentum, under a slide from 0.05 to 0.005 m/s in 0.1 ms: 1779.33 was
/// computed outside this project.
TEST(EnergyTest, PrintedDissipationFollowsTheSlide) {
  Scene scene = table_1();
  scene.sliding.profile = {{0.0, 0.05}, {1e-4, 0.005}};
  scene.run.duration_s = 1e-4;
  scene.run.window_start_s = 0.0;
  EXPECT_NEAR(power_ratios(scene, run(scene).window).dissipation_as_printed, -1779.33, 0.01);
}

}  // namespace
}  // namespace sonoglide::loop::energy_test
