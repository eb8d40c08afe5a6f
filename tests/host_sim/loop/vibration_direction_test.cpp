/// Vibration across the sliding and normal to the surface, in SI units, in open and in closed loop.

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/friction/normal_vibration_ratio.hpp"
#include "firmware/friction/transverse_vibration_ratio.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::loop::vibration_direction_test {
namespace {

using tests::compliance_m_per_N;
using tests::on_steady_orbit;
using tests::period_s;
using tests::table_1;
using tests::table_1_closed_loop;

PowerRatios window_ratios(const scene::Scene& scene) {
  return power_ratios(scene, run_logged(scene).result.window);
}

scene::Scene transverse(scene::Scene scene) {
  scene.friction.law = scene::laws::TransverseCoulomb{};
  return scene;
}

/// Of a vibration that friction hardly bends.
TEST(TransverseSceneTest, FrictionRatioIsTheClosedForm) {
  scene::Scene scene = on_steady_orbit(transverse(table_1()));
  EXPECT_NEAR(window_ratios(scene).friction_ratio, friction::transverse_vibration_ratio(0.5), 1e-4);
  scene.sliding.profile = {{0.0, -2.0 * scene.sliding.profile.front().velocity_m_per_s}};
  EXPECT_NEAR(window_ratios(scene).friction_ratio, friction::transverse_vibration_ratio(1.0), 1e-4);
}

TEST(TransverseSceneTest, FixedStepsAgree) {
  scene::Scene scene = transverse(table_1());
  const double ratio = window_ratios(scene).friction_ratio;
  scene.solver.method = scene::method_of<scene::solvers::Rk4>;
  scene.solver.step_s = period_s / 1000.0;
  EXPECT_NEAR(window_ratios(scene).friction_ratio, ratio, 1e-8);
}

/// The value is that of an integrator of other origin.
TEST(TransverseSceneTest, FollowsASlidingProfileWithinThePeriods) {
  scene::Scene scene = transverse(table_1());
  scene.sliding.profile = {{0.0, 0.01}, {1e-3, 0.05}};
  scene.run.duration_s = 1e-3;
  scene.run.window_start_s = 0.0;
  EXPECT_NEAR(window_ratios(scene).friction_ratio, 0.649584, 1e-6);
}

TEST(TransverseSceneTest, SlidingPassesZeroOverARestingOscillator) {
  scene::Scene scene = transverse(table_1());
  scene.drive->force_amplitude_N = 0.0;
  scene.run.duration_s = 2e-3;
  scene.run.window_start_s = 0.0;
  for (const double turn_s : {0.4e-3, 1e-3, 1.2345e-3}) {
    scene.sliding.profile = {{0.0, 0.02}, {2.0 * turn_s, -0.02}};
    for (const auto method :
         {scene::method_of<scene::solvers::EventTaylor>, scene::method_of<scene::solvers::Rk4>}) {
      scene.solver.method = method;
      scene.solver.step_s = period_s / 1000.0;
      const RunResult result = run_logged(scene).result;
      EXPECT_EQ(result.final_state.displacement_m, 0.0);
      EXPECT_NEAR(power_ratios(scene, result.window).friction_ratio, 1.0, 1e-3);
    }
  }
}

TEST(TransverseSceneTest, EnergyIdentity) {
  scene::Scene scene = transverse(table_1());
  scene.friction.normal_force_N = 1000.0;
  EXPECT_LE(std::abs(window_ratios(scene).balance_residual), 1e-8);
}

TEST(TransverseSceneTest, SteadyOrbitIsTheOneThatAVibrationSettlesOn) {
  scene::Scene scene = transverse(table_1());
  scene.friction.normal_force_N = 1000.0;
  scene.run.duration_s = 400.0 * period_s;
  scene.run.window_start_s = 390.0 * period_s;
  const double settled = window_ratios(scene).friction_ratio;
  scene.run.start = scene::Start::steady;
  scene.run.duration_s = 2.0 * period_s;
  scene.run.window_start_s = 0.0;
  EXPECT_NEAR(window_ratios(scene).friction_ratio, settled, 1e-6);
}

TEST(TransverseSceneTest, ClosedLoopReachesItsTargets) {
  const LoggedRun logged = run_logged(transverse(table_1_closed_loop()));
  ASSERT_TRUE(logged.result.control.has_value());
  EXPECT_TRUE(logged.result.control->faults.empty());
  EXPECT_NEAR(logged.periods[58].friction_ratio, 0.4, 0.01);
  EXPECT_NEAR(logged.periods.back().friction_ratio, 0.6, 0.01);
}

/// At 384 N the normal force vibrates by `amplitude` of itself; kx = kz / 10.
scene::Scene normal(scene::Scene scene, double amplitude) {
  const double kz = amplitude * scene.friction.normal_force_N /
                    (384.0 * std::abs(compliance_m_per_N(scene.plant)));
  scene.friction.law = scene::laws::NormalCoulomb{kz};
  scene.friction.contact_stiffness_N_per_m = 0.1 * kz;
  return scene;
}

/// Vt is half the vibration velocity, and Vc = mu kz / kx = 1 of it.
TEST(NormalSceneTest, FrictionRatioIsTheClosedForm) {
  for (const double amplitude : {0.2, 0.9}) {
    const scene::Scene scene = normal(on_steady_orbit(table_1()), amplitude);
    EXPECT_NEAR(window_ratios(scene).friction_ratio,
                friction::normal_vibration_ratio(amplitude, 0.5), 1e-9);
  }
}

TEST(NormalSceneTest, EnergyIdentity) {
  EXPECT_LE(std::abs(window_ratios(normal(table_1(), 0.7)).balance_residual), 1e-9);
}

/// Below resonance, in phase with the drive, the orbit begins with more friction than mu N0.
TEST(NormalSceneTest, SteadyOrbitIsTheClosedForms) {
  constexpr double inertia_N_per_m = tests::Table1::inertia_N_per_m;
  constexpr double table_1_N_per_m = tests::Table1::stiffness_N_per_m;
  for (const double stiffness_N_per_m :
       {table_1_N_per_m, 2.0 * inertia_N_per_m - table_1_N_per_m}) {
    scene::Scene scene = table_1();
    scene.plant.stiffness_N_per_m = stiffness_N_per_m;
    scene.plant.damping_N_s_per_m = 20.0;
    scene = normal(scene, 0.9);
    scene.run.start = scene::Start::steady;
    scene.run.duration_s = 2.0 * period_s;
    scene.run.window_start_s = 0.0;
    EXPECT_NEAR(window_ratios(scene).friction_ratio, friction::normal_vibration_ratio(0.9, 0.5),
                1e-4);
  }
}

/// With alpha the amplitude over that which opens the contact: open for acos(1/alpha)/pi of the time,
/// mean normal force N0 (acos(-1/alpha) + sqrt(alpha^2 - 1))/pi.
TEST(NormalSceneTest, SaysHowLongTheContactIsOpenAndHowItIsLoaded) {
  constexpr double pi = tests::pi;
  for (const double alpha : {0.3, 0.999, 1.001, 1.5, 20.0}) {
    const scene::Scene scene = normal(on_steady_orbit(table_1()), alpha);
    const EnergyBalance window = run_logged(scene).result.window;
    const bool opens = alpha > 1.0;
    EXPECT_NEAR(window.open_s / window.duration_s, opens ? std::acos(1.0 / alpha) / pi : 0.0, 1e-9);
    const double load =
        opens ? (std::acos(-1.0 / alpha) + std::sqrt(alpha * alpha - 1.0)) / pi : 1.0;
    EXPECT_NEAR(window.normal_impulse_N_s / window.duration_s, load * scene.friction.normal_force_N,
                1e-9 * load);
  }
}

/// The contact just touches the surface at drive phase 0, or hardly opens there.
TEST(NormalSceneTest, SteadyOrbitOfAContactThatIsAboutToOpen) {
  for (const double amplitude : {1.0 - 1e-5, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.0 + 1e-5}) {
    scene::Scene scene = normal(table_1(), amplitude);
    scene.run.start = scene::Start::steady;
    scene.run.duration_s = 2.0 * period_s;
    scene.run.window_start_s = 0.0;
    EXPECT_NEAR(window_ratios(scene).friction_ratio, friction::normal_vibration_ratio(1.0, 0.5),
                1e-4);
  }
}

TEST(NormalSceneTest, FollowsAProfileOfTheNormalForce) {
  scene::Scene scene = normal(on_steady_orbit(table_1()), 0.3);
  scene.run.start = scene::Start::given;
  scene.friction.normal_force_profile_N = {{0.0, 0.2}, {scene.run.duration_s, 0.4}};
  scene.run.window_start_s = 0.0;
  const EnergyBalance whole = run_logged(scene).result.whole;
  EXPECT_NEAR(whole.normal_impulse_N_s / whole.duration_s, 0.3, 3e-3);
}

TEST(NormalSceneTest, ClosedLoopReachesItsTargets) {
  scene::Scene scene = normal(table_1_closed_loop(), 0.4);
  scene.controller->target_friction_ratio = {{0.0, 0.8}, {1e-3, 0.6}};
  scene.run.duration_s = 4e-3;
  const LoggedRun logged = run_logged(scene);
  ASSERT_TRUE(logged.result.control.has_value());
  EXPECT_TRUE(logged.result.control->faults.empty());
  EXPECT_NEAR(logged.periods[58].friction_ratio, 0.8, 0.01);
  EXPECT_NEAR(logged.periods.back().friction_ratio, 0.6, 0.01);
}

}  // namespace
}  // namespace sonoglide::loop::vibration_direction_test
