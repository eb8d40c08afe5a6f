/// The steady orbit against long runs, which know nothing of it, and against closed forms.

#include "host_sim/loop/plant/steady_orbit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/lugre.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::loop::steady_orbit_test {
namespace {

using scene::Scene;
using tests::carrier_Hz;
using tests::period_s;
using tests::pi;
using tests::table_1;

double friction_ratio_of_steady_orbit(Scene scene) {
  scene.run.start = scene::Start::steady;
  scene.run.duration_s = period_s;
  scene.run.window_start_s = 0.0;
  return power_ratios(scene, run(scene).whole).friction_ratio;
}

double friction_ratio_after(Scene scene, int periods) {
  scene.run.duration_s = periods * period_s;
  scene.run.window_start_s = 0.9 * scene.run.duration_s;
  return power_ratios(scene, run(scene).window).friction_ratio;
}

void expect_as_after(const Scene& scene, int periods) {
  const SteadyOrbit orbit = find_steady_orbit(scene);
  EXPECT_GE(orbit.periods, 1U);
  EXPECT_LE(100 * orbit.periods, static_cast<std::uint64_t>(periods));
  EXPECT_NEAR(friction_ratio_of_steady_orbit(scene), friction_ratio_after(scene, periods), 1e-6);
}

Scene at_velocity_ratio(double force_N, double velocity_ratio) {
  Scene scene = table_1(force_N);
  scene.sliding.profile[0].velocity_m_per_s *= velocity_ratio / 0.5;
  return scene;
}

Scene resonant(double force_N, double damping_N_s_per_m) {
  Scene scene = table_1(force_N);
  scene.plant.stiffness_N_per_m = scene.plant.mass_kg * std::pow(2.0 * pi * carrier_Hz, 2);
  scene.plant.damping_N_s_per_m = damping_N_s_per_m;
  return scene;
}

// Runs that were started beside the orbit, 20 ms: the mean of the last 1 ms.
TEST(FindSteadyOrbitTest, HasTheKnownFrictionRatiosOfTable1) {
  EXPECT_NEAR(friction_ratio_of_steady_orbit(at_velocity_ratio(384.0, 0.5)), 0.6749, 1e-4);
  EXPECT_NEAR(friction_ratio_of_steady_orbit(at_velocity_ratio(1920.0, 0.5)), 0.4893, 1e-4);
  EXPECT_NEAR(friction_ratio_of_steady_orbit(at_velocity_ratio(1920.0, 0.1)), 0.0881, 1e-4);
}

// Nothing but friction takes the free vibration out, a ten thousandth of it in a carrier period.
TEST(FindSteadyOrbitTest, IsWhereTheUndampedPlantSettlesFromRest) {
  Scene scene = table_1();
  scene.solver.method = scene::method_of<scene::solvers::EventGauss>;
  scene.solver.tolerance = 1e-8;
  expect_as_after(scene, 50000);
}

TEST(FindSteadyOrbitTest, IsWhereDampedPlantsSettle) {
  Scene scene = table_1();
  scene.plant.damping_N_s_per_m = 200.0;
  EXPECT_NEAR(friction_ratio_of_steady_orbit(scene), friction_ratio_after(scene, 600), 1e-6);
  scene = resonant(384.0, 200.0);
  scene.sliding.profile[0].velocity_m_per_s = 1.0;
  EXPECT_NEAR(friction_ratio_of_steady_orbit(scene), friction_ratio_after(scene, 600), 1e-6);
}

TEST(FindSteadyOrbitTest, IsWhereStiffAndStickingContactsSettle) {
  Scene scene = table_1();
  scene.friction.normal_force_N = 2000.0;
  scene.friction.contact_stiffness_N_per_m = 1e9;
  EXPECT_NEAR(friction_ratio_of_steady_orbit(scene), friction_ratio_after(scene, 300), 1e-6);
  scene.friction.law = scene::laws::Coulomb{};
  scene.friction.normal_force_N = 3500.0;
  EXPECT_NEAR(friction_ratio_of_steady_orbit(scene), friction_ratio_after(scene, 300), 1e-6);
}

// Bristles and springs remember more than their force.
TEST(FindSteadyOrbitTest, IsWhereContactsWithMoreMemorySettle) {
  Scene scene = table_1();
  scene.plant.damping_N_s_per_m = 200.0;
  scene.friction.law = tests::damped_lugre(0.15);
  EXPECT_NEAR(friction_ratio_of_steady_orbit(scene), friction_ratio_after(scene, 600), 1e-6);
  for (const int elements : {1, 3, 8}) {
    scene.friction.law = scene::laws::Iwan{elements};
    EXPECT_NEAR(friction_ratio_of_steady_orbit(scene), friction_ratio_after(scene, 600), 1e-6);
  }
}

TEST(FindSteadyOrbitTest, IsWhereAContactThatIsMostlyStuckSettles) {
  Scene scene = at_velocity_ratio(384.0, 0.01);
  scene.plant.damping_N_s_per_m = 200.0;
  scene.friction.law = scene::laws::Iwan{1};
  EXPECT_EQ(find_steady_orbit(scene).memory.size(), 1U);
  EXPECT_NEAR(friction_ratio_of_steady_orbit(scene), friction_ratio_after(scene, 1000), 1e-6);
}

TEST(FindSteadyOrbitTest, IsWhereOtherWaveformsSettle) {
  for (const scene::Waveform waveform :
       {scene::Waveform::square, scene::Waveform::triangle, scene::Waveform::sawtooth}) {
    Scene scene = table_1();
    scene.plant.damping_N_s_per_m = 200.0;
    scene.drive->waveform = waveform;
    EXPECT_NEAR(friction_ratio_of_steady_orbit(scene), friction_ratio_after(scene, 600), 1e-6);
  }
}

// Only friction limits the vibration: over a period it takes what the drive puts in, and both take
// hundreds of thousands of periods to come to terms.
TEST(FindSteadyOrbitTest, BalancesDriveAndFrictionAtResonance) {
  Scene scene = resonant(0.02, 0.0);
  scene.sliding.profile[0].velocity_m_per_s = 0.0267;
  scene.run.start = scene::Start::steady;
  scene.run.duration_s = 20.0 * period_s;
  const RunResult result = run(scene);
  const PowerRatios ratios = power_ratios(scene, result.whole);
  EXPECT_GT(ratios.drive_input_ratio, 0.1);
  EXPECT_NEAR(ratios.stored_change_ratio, 0.0, 1e-6);
  EXPECT_LT(result.steady_orbit->multiplier, 1.0);
}

TEST(FindSteadyOrbitTest, ClosesAndTellsHowADeviationFades) {
  Scene scene = table_1();
  scene.plant.damping_N_s_per_m = 50.0;
  const SteadyOrbit orbit = find_steady_orbit(scene);
  // The natural mode without the contact, which adds a little.
  EXPECT_NEAR(orbit.multiplier, std::exp(-50.0 / (2.0 * 0.02) * period_s), 2e-4);
  scene.run.start = scene::Start::steady;
  scene.run.duration_s = 3.0 * period_s;
  const PlantState later = run(scene).final_state;
  EXPECT_NEAR(later.displacement_m, orbit.state.displacement_m, 1e-15);
  EXPECT_NEAR(later.velocity_m_per_s, orbit.state.velocity_m_per_s, 1e-10);
  EXPECT_NEAR(later.friction_force_N, orbit.state.friction_force_N, 1e-10);
}

TEST(FindSteadyOrbitTest, WithoutReversalsKeepsAFreeVibrationBesideIt) {
  const SteadyOrbit orbit = find_steady_orbit(at_velocity_ratio(384.0, 1.1));
  EXPECT_NEAR(orbit.multiplier, 1.0, largest_rounding);
  EXPECT_DOUBLE_EQ(friction_ratio_of_steady_orbit(at_velocity_ratio(384.0, 1.1)), 1.0);
}

TEST(FindSteadyOrbitTest, IsDeniedWhereThereIsNone) {
  EXPECT_THROW(find_steady_orbit(resonant(384.0, 0.0)), ComputationError);
  Scene free = table_1();
  free.plant.stiffness_N_per_m = 0.0;
  EXPECT_THROW(find_steady_orbit(free), ComputationError) << "mean friction pushes it away";
  Scene pumped = table_1();
  pumped.friction.sign_convention = scene::SignConvention::as_printed;
  EXPECT_THROW(find_steady_orbit(pumped), ComputationError);
}

}  // namespace
}  // namespace sonoglide::loop::steady_orbit_test
