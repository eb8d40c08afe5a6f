/// What makes event_gauss the fastest, without a clock: how many carrier periods it takes in one step.
/// The others are those of event_taylor. One step takes half of their time or less, and a third of it
/// is lost where they follow: with 0.5 to 0.7 of the periods left over the two methods are even.
#include "host_sim/scene/cores/solver_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "host_sim/loop/run.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/loop/random/random_scene.hpp"

namespace sonoglide::loop::fastest_method_test {
namespace {

constexpr auto event_taylor = scene::method_of<scene::solvers::EventTaylor>;
constexpr auto event_gauss = scene::method_of<scene::solvers::EventGauss>;
constexpr int periods = 60;

/// Near Table 1: every number of it within a factor of ten or more.
scene::Scene drawn_scene(tests::Dice& dice) {
  scene::Scene scene = tests::table_1(384.0 * dice.decades(0.1, 10.0));
  scene.plant.stiffness_N_per_m *= dice.decades(0.01, 10.0);
  scene.friction.contact_stiffness_N_per_m *= dice.decades(0.01, 100.0);
  scene.friction.coefficient *= dice.decades(0.1, 10.0);
  scene.sliding.profile.front().velocity_m_per_s = 0.0267 * dice.decades(0.01, 10.0);
  scene.solver.tolerance = dice.decades(1e-10, 1e-5);
  scene.run.duration_s = periods * tests::period_s;
  scene.run.window_start_s = 0.0;
  return scene;
}

RunResult result_of(scene::Scene scene, scene::SolverMethod method) {
  scene.solver.method = method;
  return run(scene);
}

double ratio(const RunResult& result, const scene::Scene& scene) {
  return result.whole.resistance_impulse_N_s / (scene.friction.limit_N() * scene.run.duration_s);
}

/// Of all carrier periods, those that were left to event_taylor.
double left_over(const RunResult& gauss, const RunResult& taylor) {
  const double steps = static_cast<double>(gauss.solver_steps) - periods;
  return std::max(0.0, steps) / (static_cast<double>(taylor.solver_steps) - periods);
}

TEST(FastestMethodTest, TakesMostPeriodsInOneStepAndErrsByTheTolerance) {
  tests::Dice dice(34);
  std::vector<double> left;
  std::vector<double> errors;
  for (int i = 0; i < 600; ++i) {
    const scene::Scene scene = drawn_scene(dice);
    if (scene::fastest_method(scene) == event_gauss) {
      const RunResult gauss = result_of(scene, event_gauss);
      const RunResult taylor = result_of(scene, event_taylor);
      left.push_back(left_over(gauss, taylor));
      errors.push_back(std::abs(ratio(gauss, scene) - ratio(taylor, scene)) /
                       scene.solver.tolerance);
    }
  }
  ASSERT_GT(left.size(), 50U);
  std::sort(left.begin(), left.end());
  std::sort(errors.begin(), errors.end());
  EXPECT_LE(left[left.size() / 2], 0.2);
  EXPECT_LE(left[left.size() * 9 / 10], 0.6);
  EXPECT_LE(errors[errors.size() * 19 / 20], 2.0);
}

}  // namespace
}  // namespace sonoglide::loop::fastest_method_test
