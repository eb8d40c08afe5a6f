/// Whole runs against values known to more than 20 digits and against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/csv/csv.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::loop::open_loop_reference_test {
namespace {

using scene::Scene;
using tests::on_steady_orbit;
using tests::period_s;
using tests::table_1;
using tests::vibration_velocity_m_per_s;

struct Values {
  double displacement_m;
  double velocity_m_per_s;
  double friction_N;
  double friction_ratio;
  double friction_ratio_second_half;
  double dissipation_ratio;
  double dissipation_ratio_second_half;
};

Values reference(const std::string& name) {
  const csv::Table table = csv::read_file(REFERENCE_OPEN_LOOP);
  const csv::Row& row = table.row_of("scene", name);
  return {row.number("x_end_m"),    row.number("v_end_m_per_s"), row.number("F_end_N"),
          row.number("rho_all"),    row.number("rho_last"),      row.number("phi_fu_all"),
          row.number("phi_fu_last")};
}

PowerRatios ratios(const Scene& scene, const EnergyBalance& energy) {
  return power_ratios(energy, scene.friction.limit_N(), scene.friction.sign_convention, period_s);
}

Values values(const Scene& scene) {
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

Scene reference_scene(const std::string& name) {
  Scene scene = table_1();
  if (name != "table1" && name != "table1_as_printed") {
    scene.friction.contact_stiffness_N_per_m = 1e9;
  }
  if (name == "heavy_friction") {
    scene.friction.normal_force_N = 2000.0;
  }
  if (name == "table1_as_printed") {
    scene.friction.sign_convention = scene::SignConvention::as_printed;
  }
  return scene;
}

void expect_near(const Values& actual, const Values& expected, double relative) {
  const auto close = [relative](double a, double b) { EXPECT_NEAR(a, b, relative * std::abs(b)); };
  close(actual.displacement_m, expected.displacement_m);
  close(actual.velocity_m_per_s, expected.velocity_m_per_s);
  close(actual.friction_N, expected.friction_N);
  close(actual.friction_ratio, expected.friction_ratio);
  close(actual.friction_ratio_second_half, expected.friction_ratio_second_half);
  close(actual.dissipation_ratio, expected.dissipation_ratio);
  close(actual.dissipation_ratio_second_half, expected.dissipation_ratio_second_half);
}

class OpenLoopReferenceTest : public testing::TestWithParam<std::string> {};

TEST_P(OpenLoopReferenceTest, HoldsToNineDigitsAtATightTolerance) {
  Scene scene = reference_scene(GetParam());
  scene.solver.tolerance = 1e-12;
  expect_near(values(scene), reference(GetParam()), 1e-9);
}

TEST_P(OpenLoopReferenceTest, HoldsToSevenDigitsAtTheDefaultTolerance) {
  expect_near(values(reference_scene(GetParam())), reference(GetParam()), 1e-7);
}

TEST_P(OpenLoopReferenceTest, HoldsToFourDigitsAtALooseTolerance) {
  Scene scene = reference_scene(GetParam());
  scene.solver.tolerance = 1e-6;
  const Values actual = values(scene);
  const Values expected = reference(GetParam());
  EXPECT_NEAR(actual.friction_ratio, expected.friction_ratio, 1e-4);
  EXPECT_NEAR(actual.dissipation_ratio, expected.dissipation_ratio, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Scenes, OpenLoopReferenceTest,
                         testing::Values("table1", "stiff_contact", "heavy_friction",
                                         "table1_as_printed"),
                         [](const auto& name) { return name.param; });

TEST(OpenLoopRk4Test, ThePapersStepHoldsToSixDigits) {
  for (const char* name : {"table1", "table1_as_printed"}) {
    Scene scene = reference_scene(name);
    scene.solver.method = scene::method_of<scene::solvers::Rk4>;
    scene.solver.step_s = 1.667e-8;
    const Values actual = values(scene);
    const Values expected = reference(name);
    const auto close = [](double a, double b) { EXPECT_NEAR(a / b, 1.0, 1e-6); };
    close(actual.displacement_m, expected.displacement_m);
    close(actual.friction_ratio, expected.friction_ratio);
    close(actual.friction_ratio_second_half, expected.friction_ratio_second_half);
    close(actual.dissipation_ratio, expected.dissipation_ratio);
    close(actual.dissipation_ratio_second_half, expected.dissipation_ratio_second_half);
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
  Scene scene = reference_scene("table1");
  scene.solver = GetParam().solver;
  const Values actual = values(scene);
  const Values expected = reference("table1");
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
