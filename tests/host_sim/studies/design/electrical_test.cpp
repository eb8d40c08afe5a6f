/// What a design says of the amplifier: against circuit formulas.

#include "host_sim/studies/design/study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "tests/host_sim/loop/steady/scenes/steady_scenes.hpp"

namespace sonoglide::design::electrical_test {
namespace {

using steady::table_1;

constexpr double force_factor_N_per_V = 16.0;
constexpr double coupling = 0.49;  // square

/// Table 1 behind a transducer of a coupling that is assumed; damped.
scene::Scene transducer_scene() {
  scene::Scene scene = table_1();
  scene.plant.damping_N_s_per_m = 37.7;
  const double motional_F =
      force_factor_N_per_V * force_factor_N_per_V / scene.plant.stiffness_N_per_m;
  scene.transducer = {force_factor_N_per_V, motional_F * (1.0 / coupling - 1.0), 0.0};
  scene.drive->max_force_amplitude_N = 0.0;
  scene.drive->max_voltage_amplitude_V = 120.0;
  return scene;
}

std::complex<double> admittance_S(const scene::Scene& scene) {
  using namespace std::complex_literals;
  const double omega = tests::two_pi * scene.drive->frequency_Hz;
  const double square = force_factor_N_per_V * force_factor_N_per_V;
  return 1i * omega * scene.transducer->clamped_capacitance_F +
         1.0 / (scene.plant.damping_N_s_per_m / square +
                1i * (omega * scene.plant.mass_kg / square -
                      scene.plant.stiffness_N_per_m / (square * omega)));
}

TEST(ElectricalDesignTest, KnowsCouplingAndResonances) {
  const scene::Scene scene = transducer_scene();
  EXPECT_NEAR(coupling_square(scene), coupling, 1e-12);
  const double series_Hz = scene.plant.natural_Hz();
  EXPECT_NEAR(series_Hz, 12978.69283885656, 1e-6);
  const double parallel_Hz = parallel_resonance_Hz(scene);
  EXPECT_NEAR(1.0 - series_Hz * series_Hz / (parallel_Hz * parallel_Hz), coupling, 1e-12);
}

// ω F² (1/k² - 1)/(2 Ks), whatever the voltage.
TEST(ElectricalDesignTest, TheClampedCapacitanceTakesItsPower) {
  const scene::Scene scene = transducer_scene();
  EXPECT_NEAR(clamped_power_VA(scene, 384.0 / force_factor_N_per_V), 217.5, 0.05);
  EXPECT_NEAR(clamped_power_VA(scene, 526.3 / force_factor_N_per_V), 408.6, 0.05);
  EXPECT_NEAR(clamped_power_VA(scene, 1920.0 / force_factor_N_per_V), 5438.0, 0.5);
}

// Friction is so light that the circuit without it takes the same.
TEST(ElectricalDesignTest, ARequirementTakesThePowersOfTheCircuit) {
  const scene::Scene scene = transducer_scene();
  const steady::Requirement requirement = steady::require_ratio(scene, 0.02672, 0.5);
  ASSERT_TRUE(requirement.motion.electrical);
  const loop::ElectricalFigures& figures = *requirement.motion.electrical;
  EXPECT_NEAR(figures.voltage_peak_V, requirement.motion.drive_force_N / force_factor_N_per_V,
              1e-9 * figures.voltage_peak_V);
  const double current_A = std::abs(admittance_S(scene)) * figures.voltage_peak_V;
  EXPECT_NEAR(figures.current_peak_A, current_A, 1e-4 * current_A);
  EXPECT_NEAR(figures.apparent_power_VA, 0.5 * figures.voltage_peak_V * current_A,
              1e-4 * figures.apparent_power_VA);
  const double inductance_H = matching_inductance_H(scene, figures);
  const double omega = tests::two_pi * scene.drive->frequency_Hz;
  EXPECT_NEAR(1.0 / (omega * inductance_H), admittance_S(scene).imag(),
              1e-4 * admittance_S(scene).imag());
}

// The vibration stays: at resonance its force is that of damping and friction, c v + 4 Fc/π at most.
TEST(ElectricalDesignTest, ResonanceSavesVoltage) {
  const scene::Scene scene = transducer_scene();
  const steady::Requirement here = steady::require_ratio(scene, 0.02672, 0.5);
  const ResonantSpring spring = on_resonance(scene, here);
  ASSERT_TRUE(spring.requirement.motion.electrical);
  const double omega = tests::two_pi * scene.drive->frequency_Hz;
  EXPECT_NEAR(spring.stiffness_N_per_m, scene.plant.mass_kg * omega * omega, 1.0);
  const double damping_N =
      scene.plant.damping_N_s_per_m * spring.requirement.motion.velocity_amplitude_m_per_s;
  EXPECT_GT(spring.requirement.motion.drive_force_N, damping_N);
  EXPECT_LT(spring.requirement.motion.drive_force_N,
            damping_N + 4.0 / tests::pi * scene.friction.limit_N());
  EXPECT_LT(spring.requirement.motion.electrical->apparent_power_VA,
            1e-3 * here.motion.electrical->apparent_power_VA);
}

TEST(ElectricalDesignTest, AnInductorOnlyHelpsACapacitance) {
  loop::ElectricalFigures figures{};
  figures.voltage_peak_V = 10.0;
  figures.reactive_power_var = 1.0;
  EXPECT_TRUE(std::isnan(matching_inductance_H(transducer_scene(), figures)));
}

}  // namespace
}  // namespace sonoglide::design::electrical_test
