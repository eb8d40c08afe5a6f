/// Friction laws and waveforms in SI units, in open and in closed loop.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "firmware/friction/stribeck_friction_ratio.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/common/lugre.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::loop::friction_laws_test {
namespace {

using tests::bare_lugre;
using tests::damped_lugre;
using tests::on_steady_orbit;
using tests::period_s;
using tests::table_1;
using tests::table_1_closed_loop;

scene::Scene lugre(scene::Scene scene, const scene::laws::LuGre& law) {
  scene.friction.law = law;
  return scene;
}

PowerRatios window_ratios(const scene::Scene& scene) {
  const double friction_N = scene.friction.coefficient * scene.friction.normal_force_N;
  return power_ratios(run_logged(scene).result.window, friction_N, scene.friction.sign_convention,
                      period_s);
}

double window_ratio(const scene::Scene& scene) {
  return window_ratios(scene).friction_ratio;
}

TEST(LuGreSceneTest, EnergyIdentity) {
  scene::Scene scene = lugre(table_1(), damped_lugre(0.13));
  scene.solver.tolerance = 1e-12;
  EXPECT_LE(std::abs(window_ratios(scene).balance_residual), 1e-9);
}

TEST(LuGreSceneTest, WithoutItsOwnPartsIsDahl) {
  EXPECT_NEAR(window_ratio(lugre(table_1(), bare_lugre(0.1, 1.0))), window_ratio(table_1()), 1e-9);
}

/// Damped bristles add nothing to the mean, viscous friction adds sigma2 Vt / Fc to it and to what
/// the slide meets without vibration.
TEST(LuGreSceneTest, ViscousFrictionAddsItsShare) {
  const scene::Scene dahl = on_steady_orbit(table_1());
  const double viscous_N_s_per_m = 0.1;
  const double share = viscous_N_s_per_m * dahl.sliding.profile.front().velocity_m_per_s /
                       tests::Table1::friction_limit_N;
  scene::laws::LuGre law = bare_lugre(0.1, 1.0);
  law.bristle_damping_N_s_per_m = 0.05;
  law.viscous_friction_N_s_per_m = viscous_N_s_per_m;
  EXPECT_NEAR(window_ratio(lugre(dahl, law)), (window_ratio(dahl) + share) / (1.0 + share), 2e-5);
}

TEST(LuGreSceneTest, ClosedLoopReachesItsTargets) {
  const scene::Scene scene = lugre(table_1_closed_loop(), damped_lugre(0.13));
  const LoggedRun logged = run_logged(scene);
  ASSERT_TRUE(logged.result.control.has_value());
  EXPECT_TRUE(logged.result.control->faults.empty());
  EXPECT_NEAR(logged.periods[58].friction_ratio, 0.4, 0.01);
  EXPECT_NEAR(logged.periods.back().friction_ratio, 0.6, 0.01);
}

scene::Scene iwan(scene::Scene scene, int elements) {
  scene.friction.law = scene::laws::Iwan{elements};
  return scene;
}

TEST(IwanSceneTest, EnergyIdentity) {
  scene::Scene scene = iwan(table_1(), 5);
  scene.solver.tolerance = 1e-12;
  EXPECT_LE(std::abs(window_ratios(scene).balance_residual), 1e-9);
}

/// kappa = 0.4045 at 384 N: friction does not fall below 1 - kappa, but for what the slide adds.
TEST(IwanSceneTest, OneElementKeepsItsFloor) {
  scene::Scene scene = iwan(table_1(), 1);
  scene.run.start = scene::Start::steady;
  scene.sliding.profile[0].velocity_m_per_s *= 0.002;
  EXPECT_NEAR(window_ratio(scene), 1.0 - 0.4045, 5e-3);
}

/// The force of the scene is that of a first load: stiff enough, it stays within it.
TEST(IwanSceneTest, BeginsAtItsInitialForce) {
  scene::Scene scene = iwan(table_1(0.0), 3);
  scene.friction.initial_force_N = 0.015;
  scene.plant.stiffness_N_per_m = 1e15;
  scene.sliding.profile[0].velocity_m_per_s = 1e-12;
  scene.drive.reset();
  scene.run.record = {scene::Channel::friction_force};
  scene.run.record_interval_s = scene.run.duration_s;
  EXPECT_NEAR(run_logged(scene).trace.state.front().friction_force_N, 0.015, 1e-12);
}

TEST(IwanSceneTest, ClosedLoopReachesItsTargets) {
  const scene::Scene scene = iwan(table_1_closed_loop(), 8);
  const LoggedRun logged = run_logged(scene);
  ASSERT_TRUE(logged.result.control.has_value());
  EXPECT_TRUE(logged.result.control->faults.empty());
  EXPECT_NEAR(logged.periods[58].friction_ratio, 0.4, 0.01);
  EXPECT_NEAR(logged.periods.back().friction_ratio, 0.6, 0.01);
}

/// A slow resonator that sticks and slips on the falling curve at 10 mm/s.
scene::Scene stick_slip(double dither_N) {
  scene::Scene scene = table_1(dither_N);
  scene.plant.stiffness_N_per_m = 8e3;
  scene.friction.law = scene::laws::Stribeck{1.5, 50.0};
  scene.friction.coefficient = 0.2;
  scene.friction.normal_force_N = 10.0;
  scene.sliding.profile = {{0.0, 0.01}};
  scene.solver.tolerance = 1e-6;
  scene.run.duration_s = 0.1;
  scene.run.window_start_s = 0.08;
  scene.run.record = {scene::Channel::displacement};
  scene.run.record_interval_s = 1e-4;
  return scene;
}

/// Of the last fifth of the run: the natural mode goes round twice.
double swing_m(const scene::Scene& scene) {
  const Recording trace = run_logged(scene).trace;
  double lowest = trace.state.back().displacement_m;
  double highest = lowest;
  for (std::size_t i = 0; i < trace.state.size(); ++i) {
    if (trace.time_s[i] >= 0.08) {
      lowest = std::min(lowest, trace.state[i].displacement_m);
      highest = std::max(highest, trace.state[i].displacement_m);
    }
  }
  return highest - lowest;
}

TEST(StribeckSceneTest, DitherQuenchesStickSlip) {
  EXPECT_GT(swing_m(stick_slip(0.0)), 1e-5);
  EXPECT_LT(swing_m(stick_slip(384.0)), 1e-6);
}

/// At zeta = 1/2, of a vibration that friction hardly bends.
TEST(StribeckSceneTest, FrictionRatioIsThatOfTheAveragedCurve) {
  scene::Scene scene = on_steady_orbit(table_1());
  scene.friction.law = scene::laws::Stribeck{1.5, 200.0};
  const double speed = 2.0 * scene.sliding.profile.front().velocity_m_per_s;
  const double fall = 15.0 * speed;
  const double rise = 2000.0 * speed * speed * speed;
  const double over_limit = friction::stribeck_friction_ratio(0.5, fall, rise);
  EXPECT_NEAR(window_ratio(scene), over_limit / (1.0 - 0.5 * fall + 0.125 * rise), 1e-3);
  EXPECT_NEAR(window_ratios(scene).pull_ratio, over_limit, 1e-3);
}

/// A mass without a spring, and next to no friction: A / (m f) is 320 mm/s.
scene::Scene free_mass(scene::Waveform waveform, double first_m_per_s, double sliding_m_per_s) {
  scene::Scene scene = table_1();
  scene.plant.stiffness_N_per_m = 0.0;
  scene.plant.initial_velocity_m_per_s = first_m_per_s;
  scene.friction.law = scene::laws::Coulomb{};
  scene.friction.coefficient = 1e-6;
  scene.sliding.profile = {{0.0, sliding_m_per_s}};
  scene.drive->waveform = waveform;
  scene.solver.order = 16;
  return scene;
}

/// The friction ratio of two whole periods, from inside one of them on.
double ratio_of_periods(scene::Scene scene) {
  scene.run.window_start_s = period_s / 3.0;
  scene.run.duration_s = period_s * (2.0 + 1.0 / 3.0);
  return window_ratio(scene);
}

TEST(WaveformSceneTest, SquareWave) {
  EXPECT_NEAR(ratio_of_periods(free_mass(scene::Waveform::square, -0.08, 0.04)), 0.5, 1e-6);
}

TEST(WaveformSceneTest, TriangleWave) {
  EXPECT_NEAR(ratio_of_periods(free_mass(scene::Waveform::triangle, 0.0, 0.02)),
              1.0 - std::sqrt(0.5), 1e-6);
}

TEST(WaveformSceneTest, SawtoothWave) {
  const double sliding_m_per_s = 0.01;
  EXPECT_NEAR(ratio_of_periods(free_mass(scene::Waveform::sawtooth, -0.32 / 6.0, sliding_m_per_s)),
              2.0 * std::sqrt(1.0 / 3.0 + 4.0 * sliding_m_per_s / 0.32) - 1.0, 1e-6);
}

TEST(WaveformSceneTest, TheTraceShowsTheWave) {
  scene::Scene scene = free_mass(scene::Waveform::triangle, 0.0, 0.02);
  scene.run.record = {scene::Channel::drive_force};
  scene.run.record_interval_s = 0.05 * period_s;
  const Recording trace = run_logged(scene).trace;
  ASSERT_GT(trace.time_s.size(), 1000U);
  for (std::size_t i = 0; i < trace.time_s.size(); ++i) {
    const double phase = std::fmod(trace.time_s[i] / period_s, 1.0);
    EXPECT_NEAR(trace.drive_force_N[i], 384.0 * (std::abs(4.0 * phase - 2.0) - 1.0), 1e-6);
  }
}

}  // namespace
}  // namespace sonoglide::loop::friction_laws_test
