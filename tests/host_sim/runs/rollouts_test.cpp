#include "host_sim/runs/rollouts.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <deque>
#include <stdexcept>
#include <vector>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/process/thread_limit.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::runs::rollouts_test {
namespace {

using Ratios = std::vector<double>;

scene::Scene closed_loop(double tolerance) {
  scene::Scene scene = tests::table_1_closed_loop(scene::Arithmetic::q31);
  scene.solver.tolerance = tolerance;
  return scene;
}

Ratios as_run(const scene::Scene& scene) {
  loop::PeriodRecording recording;
  loop::Watch watch;
  watch.periods.push_back(&recording);
  loop::run(scene, watch);
  Ratios ratios;
  for (const loop::Period& period : recording.periods) {
    ratios.push_back(period.friction_ratio);
  }
  return ratios;
}

std::vector<Ratios> rolled_out(const std::vector<scene::Scene>& scenes, unsigned threads) {
  std::vector<Ratios> rows;
  for (const scene::Scene& scene : scenes) {
    rows.emplace_back(whole_periods(scene));
  }
  std::deque<configure::Experiment> experiments;
  std::vector<Rollout> rollouts;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    rollouts.push_back(
        {experiments.emplace_back(configure::make_experiment(scenes[i])), nullptr, rows[i].data()});
  }
  const process::ThreadLimit limit(threads);
  run_rollouts(rollouts);
  return rows;
}

TEST(Rollouts, AreAsRunHasThem) {
  const scene::Scene scene = closed_loop(1e-10);
  EXPECT_EQ(rolled_out({scene}, 1).front(), as_run(scene));
}

TEST(Rollouts, InLanesAreTheSameOnAnyNumberOfThreads) {
  std::vector<scene::Scene> scenes(40, closed_loop(1e-6));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    scenes[i].plant.stiffness_N_per_m *= 1.0 + 1e-3 * static_cast<double>(i);
  }
  const std::vector<Ratios> one = rolled_out(scenes, 1);
  EXPECT_EQ(one, rolled_out(scenes, 3));
  const Ratios expected = as_run(scenes[7]);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_NEAR(one[7][i], expected[i], 1e-5) << i;
  }
}

TEST(Rollouts, TargetsOf0LeaveTheScenesSteps) {
  const scene::Scene scene = closed_loop(1e-6);
  const std::vector<double> targets(whole_periods(scene), 0.0);
  Ratios ratios(targets.size());
  run_rollouts({{configure::make_experiment(scene), targets.data(), ratios.data()}});
  EXPECT_EQ(ratios, as_run(scene));
}

TEST(Rollouts, RefuseTargetsOutOfRangeAndInOpenLoop) {
  scene::Scene scene = closed_loop(1e-10);
  std::vector<double> targets(whole_periods(scene), 0.5);
  Ratios ratios(targets.size(), -1.0);
  targets.back() = 1.25;
  EXPECT_THROW(run_rollouts({{configure::make_experiment(scene), targets.data(), ratios.data()}}),
               std::invalid_argument);
  EXPECT_EQ(ratios.front(), -1.0);
  scene.controller.reset();
  EXPECT_THROW(run_rollouts({{configure::make_experiment(scene), targets.data(), ratios.data()}}),
               configure::ConfigurationError);
}

}  // namespace
}  // namespace sonoglide::runs::rollouts_test
