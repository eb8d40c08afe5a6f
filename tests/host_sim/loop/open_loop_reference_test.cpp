/// Whole runs against values known to more than 20 digits and against closed forms.

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/reference/open_loop.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::loop::open_loop_reference_test {
namespace {

namespace open_loop = tests::open_loop;
using scene::Scene;
using tests::on_steady_orbit;
using tests::period_s;
using tests::table_1;
using tests::vibration_velocity_m_per_s;

PowerRatios ratios(const Scene& scene, const EnergyBalance& energy) {
  return power_ratios(energy, scene.friction.limit_N(), scene.friction.sign_convention, period_s);
}

open_loop::Values values(const Scene& scene) {
  const RunResult result = run(scene);
  const PowerRatios whole = ratios(scene, result.whole);
  const PowerRatios window = ratios(scene, result.window);
  return {result.final_state.displacement_m,
          result.final_state.velocity_m_per_s,
          result.final_state.friction_force_N,
          whole.friction_ratio,
          window.friction_ratio,
          whole.dissipation_ratio,
          window.dissipation_ratio};
}

Scene scene_of(const open_loop::Scene& reference) {
  Scene scene = table_1();
  scene.friction.contact_stiffness_N_per_m = reference.contact_stiffness_N_per_m;
  scene.friction.normal_force_N = reference.normal_force_N;
  if (reference.vibration_sign < 0.0) {
    scene.friction.sign_convention = scene::SignConvention::as_printed;
  }
  return scene;
}

TEST(OpenLoopReferenceTest, HoldsToSevenDigitsAtTheDefaultTolerance) {
  for (const open_loop::Scene& reference : open_loop::scenes) {
    expect_known(values(scene_of(reference)), reference, 1e-7);
  }
}

/// All that units and scales may cost.
TEST(OpenLoopReferenceTest, HoldsToNineDigitsAtATightTolerance) {
  for (const open_loop::Scene& reference : open_loop::scenes) {
    Scene scene = scene_of(reference);
    scene.solver.tolerance = 1e-12;
    expect_known(values(scene), reference, 1e-9);
  }
}

TEST(OpenLoopRk4Test, ThePapersStepIsAThousandthOfTheCarrierPeriod) {
  Scene scene = table_1();
  scene.solver.method = scene::method_of<scene::solvers::Rk4>;
  scene.solver.step_s = 1.667e-8;
  EXPECT_EQ(run(scene).solver_steps, 100000U);
}

/// A solver setting and the relative error of the friction ratio that it keeps on Table 1.
struct Setting {
  std::string name;
  scene::Solver solver;
  double error;
};

scene::Solver taylor(int order, double tolerance) {
  return {scene::method_of<scene::solvers::EventTaylor>, tolerance, order, 0.0};
}

scene::Solver gauss(double tolerance) {
  return {scene::method_of<scene::solvers::EventGauss>, tolerance, std::nullopt, 0.0};
}

scene::Solver fixed_step(scene::SolverMethod method, double steps_per_period) {
  return {method, 0.0, std::nullopt, period_s / steps_per_period};
}

const Setting settings[] = {
    {"taylor_8", taylor(8, 1e-6), 1e-5},
    {"taylor_12", taylor(12, 1e-10), 1e-8},
    {"taylor_16", taylor(16, 1e-12), 1e-9},
    {"gauss_8", gauss(1e-8), 1e-8},
    {"gauss_12", gauss(1e-10), 1e-10},
    {"strang", {scene::method_of<scene::solvers::Strang>, 1e-5, std::nullopt, 0.0}, 1e-5},
    {"strang_400_steps",
     {scene::method_of<scene::solvers::Strang>, 1e-2, std::nullopt, period_s / 400.0},
     1e-4},
    {"rk4", fixed_step(scene::method_of<scene::solvers::Rk4>, 1000.0), 1e-6},
    {"rk4_event", fixed_step(scene::method_of<scene::solvers::Rk4Event>, 100.0), 1e-6},
};

class SolverTest : public testing::TestWithParam<Setting> {};

TEST_P(SolverTest, IsTheOneThatTheSceneNames) {
  Scene scene = table_1();
  scene.solver = GetParam().solver;
  const open_loop::Values actual = values(scene);
  const open_loop::Values expected = known(open_loop::table_1);
  EXPECT_NEAR(actual.friction_ratio / expected.friction_ratio, 1.0, GetParam().error);
  EXPECT_NEAR(actual.dissipation_ratio / expected.dissipation_ratio, 1.0, GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(Settings, SolverTest, testing::ValuesIn(settings),
                         [](const auto& setting) { return setting.param.name; });

/// A run from the steady orbit; the mean of its last part.
double steady_friction_ratio(double force_N, double velocity_ratio) {
  Scene scene = on_steady_orbit(table_1(force_N));
  scene.sliding.profile[0].velocity_m_per_s =
      velocity_ratio * vibration_velocity_m_per_s(scene.plant, force_N);
  scene.run.duration_s = 20e-3;
  scene.run.window_start_s = 19e-3;
  return ratios(scene, run(scene).window).friction_ratio;
}

TEST(SteadyOrbitTest, GivesTheClosedFormMapOfTheDahlContact) {
  // The map at the Dahl numbers 0.4046 and 2.023; friction shifts the orbit by less than 0.001.
  EXPECT_NEAR(steady_friction_ratio(384.0, 0.5), 0.67494, 0.002);
  EXPECT_NEAR(steady_friction_ratio(1920.0, 0.5), 0.48927, 0.002);
  EXPECT_NEAR(steady_friction_ratio(1920.0, 0.1), 0.08814, 0.002);
}

}  // namespace
}  // namespace sonoglide::loop::open_loop_reference_test
