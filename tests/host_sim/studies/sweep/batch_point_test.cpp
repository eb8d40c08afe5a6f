/// Points over lanes agree with the scalar solver within the tolerance asked for.

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/studies/sweep/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/host_sim/studies/sweep/scenes/base_scenes.hpp"

namespace sonoglide::sweep::batch_point_test {
namespace {

using Texts = std::vector<std::string>;

scene::Scene scene_with(const Texts& overrides, const std::string& text = open_loop) {
  return experiment::read_text(text, "scene.toml", overrides).plant;
}

bool taken(const Texts& overrides, const std::string& text = open_loop) {
  return batch_point(scene_with(overrides, text)).has_value();
}

TEST(BatchPointTest, TakesWhatTheLanesCanDo) {
  EXPECT_TRUE(taken({"solver.tolerance=1e-4"}));
  EXPECT_TRUE(taken({"solver.tolerance=1e-8", "friction.sign_convention=as_printed"}));
  EXPECT_TRUE(taken({"solver.tolerance=1e-4", "run.duration_periods=33"}));
}

TEST(BatchPointTest, LeavesTheRestToTheScalarSolver) {
  EXPECT_FALSE(taken({})) << "the default tolerance is finer than the lanes'";
  EXPECT_FALSE(taken({"solver.tolerance=1e-4", "solver.order=8"}));
  EXPECT_FALSE(taken({"solver.tolerance=1e-4", "run.duration_periods=33.5"}));
  EXPECT_FALSE(taken({"solver.tolerance=1e-4", "run.window_start_periods=0.25"}));
  EXPECT_FALSE(taken({"solver.tolerance=1e-4", "friction.coefficient=0"}));
  EXPECT_FALSE(taken({"solver.tolerance=1e-4", "run.start='steady'"}));
  scene::Scene moving = scene_with({"solver.tolerance=1e-4"});
  moving.friction.coefficient_profile = {{0.0, 0.1}, {1e-4, 0.2}};
  EXPECT_FALSE(batch_point(moving).has_value());
  EXPECT_FALSE(taken({"solver.tolerance=1e-4", "plant.stiffness_N_per_m=0"})) << "a mass drifts";
  EXPECT_FALSE(taken({"solver.tolerance=1e-4", "plant.stiffness_N_per_m=1e10"})) << "a fast mode";
  EXPECT_FALSE(taken({"solver.method=rk4", "solver.step_s=1.667e-8"}));
  EXPECT_FALSE(taken({"solver.tolerance=1e-4"}, closed_loop));
}

TEST(BatchPointTest, TheToleranceChoosesTheLanes) {
  const auto accuracy = [](const char* tolerance) {
    return batch_point(scene_with({std::string("solver.tolerance=") + tolerance}))->accuracy;
  };
  EXPECT_EQ(accuracy("1e-4"), batch::Accuracy::map);
  EXPECT_EQ(accuracy("1e-5"), batch::Accuracy::fine);
  EXPECT_EQ(accuracy("1e-8"), batch::Accuracy::fine);
}

void expect_agreement(const Texts& overrides, double tolerance) {
  SCOPED_TRACE(testing::PrintToString(overrides));
  Texts coarse = overrides;
  coarse.push_back(tolerance > 1e-6 ? "solver.tolerance=1e-4" : "solver.tolerance=1e-8");
  const auto point = batch_point(scene_with(coarse));
  ASSERT_TRUE(point.has_value());
  const std::vector<batch::DahlRun> runs =
      batch::run_dahl_plants({point->plant}, point->length, point->accuracy);
  ASSERT_EQ(runs.front().status, batch::RunStatus::solved);
  const PointResult lanes = row_of(*point, runs.front());
  Texts fine = overrides;
  fine.push_back("solver.tolerance=1e-12");
  const PointResult scalar =
      solve_scalar_point(experiment::read_text(open_loop, "scene.toml", fine));
  const auto expect_near = [tolerance](double value, double reference) {
    EXPECT_NEAR(value, reference, tolerance * std::max(1.0, std::abs(reference)));
  };
  expect_near(lanes.friction_ratio_whole_run, scalar.friction_ratio_whole_run);
  expect_near(lanes.friction_ratio_window, scalar.friction_ratio_window);
  expect_near(lanes.dissipation_ratio_window, scalar.dissipation_ratio_window);
}

TEST(BatchPointTest, AgreesWithTheScalarSolverWithinTheTolerance) {
  const std::vector<Texts> scenes = {
      {},
      {"sliding.velocity_m_per_s=-0.0267"},
      {"sliding.velocity_m_per_s=0.005", "friction.contact_stiffness_N_per_m=1e6"},
      {"sliding.velocity_m_per_s=0.07"},
      {"friction.sign_convention=as_printed"},
      {"plant.damping_N_s_per_m=300", "friction.normal_force_N=50"},
      {"plant.initial_displacement_m=1e-7", "plant.initial_velocity_m_per_s=0.01",
       "friction.initial_force_N=0.01"},
  };
  for (const Texts& overrides : scenes) {
    expect_agreement(overrides, 1e-4);
    expect_agreement(overrides, 1e-8);
  }
}

}  // namespace
}  // namespace sonoglide::sweep::batch_point_test
