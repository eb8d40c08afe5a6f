/// The tolerance of the solvers that promise one of the friction ratio, held over random scenes of
/// every law: a hundred carrier periods, against a run at 1e-13.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene/cores/solver_choice.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/host_sim/loop/random/random_scene.hpp"

namespace sonoglide::loop::tolerance_test {
namespace {

using tests::Dice;
constexpr int scene_count = 60;
constexpr int periods = 100;

double friction_ratio(scene::Scene scene, scene::SolverMethod method, double tolerance) {
  scene.solver.method = method;
  scene.solver.tolerance = tolerance;
  return run(scene).whole.resistance_impulse_N_s /
         (scene.friction.limit_N() * scene.run.duration_s);
}

/// Of the friction ratio, in tolerances: each one that a solver of the law has made, rising.
std::vector<double> errors(const scene::FrictionLaw& law, bool has_spring) {
  constexpr scene::SolverMethod finest = scene::method_of<scene::solvers::EventTaylor>;
  std::vector<double> errors;
  Dice dice(2013);
  for (int i = 0; i < scene_count; ++i) {
    const scene::Scene scene = tests::random_scene(dice, law, has_spring, periods);
    const double exact = friction_ratio(scene, finest, 1e-13);
    for (const auto method : {finest, scene::method_of<scene::solvers::EventGauss>}) {
      for (int digits = 3; digits <= 10 && scene::solves(method, law); ++digits) {
        const double tolerance = std::pow(10.0, -digits);
        errors.push_back(std::abs(friction_ratio(scene, method, tolerance) - exact) / tolerance);
      }
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

class ToleranceTest : public testing::TestWithParam<scene::FrictionLaw> {};

TEST_P(ToleranceTest, IsKeptWithoutASpring) {
  EXPECT_LE(errors(GetParam(), false).back(), 1.0);
}

/// Where the vibration only just reverses the sliding, the ratio is as sensitive as that.
TEST_P(ToleranceTest, IsKeptWithASpringButWhereTheSlidingOnlyJustReverses) {
  const std::vector<double> found = errors(GetParam(), true);
  EXPECT_LE(found[found.size() * 19 / 20], 1.0);
  EXPECT_LE(found.back(), 10.0);
}

std::vector<scene::FrictionLaw> laws_with_a_ratio() {
  std::vector<scene::FrictionLaw> laws(scene::every_law.begin(), scene::every_law.end());
  laws.erase(std::remove_if(laws.begin(), laws.end(), scene::is<scene::laws::None>), laws.end());
  return laws;
}

INSTANTIATE_TEST_SUITE_P(Laws, ToleranceTest, testing::ValuesIn(laws_with_a_ratio()),
                         [](const auto& tested) {
                           return std::string(scene::name_of(tested.param));
                         });

}  // namespace
}  // namespace sonoglide::loop::tolerance_test
