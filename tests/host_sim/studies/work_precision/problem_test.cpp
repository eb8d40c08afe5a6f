#include "host_sim/studies/work_precision/comparison.hpp"

#include <gtest/gtest.h>

#include <string>

#include "host_sim/configure/configuration_error.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/studies/work_precision/peers/published/published_problems.hpp"

namespace sonoglide::work_precision::problem_test {
namespace {

scene::Scene table_1() {
  scene::Scene scene = tests::table_1();
  scene.run.window_start_s = 0.0;
  return scene;
}

std::string refused_key(const scene::Scene& scene) {
  try {
    problem_of(scene);
  } catch (const configure::ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()), "");
    return error.key();
  }
  return {};
}

TEST(ProblemTest, IsThePublishedOneInWhateverUnitOfLength) {
  const peers::Problem problem = problem_of(table_1());
  const peers::Problem known = peers::published_problem("table1");
  EXPECT_DOUBLE_EQ(problem.stiffness, known.stiffness);
  EXPECT_EQ(problem.damping, 0.0);
  // The numbers that no choice of length changes.
  EXPECT_DOUBLE_EQ(problem.friction_force / problem.drive_amplitude, known.friction_force);
  EXPECT_DOUBLE_EQ(problem.contact_stiffness * problem.drive_amplitude, known.contact_stiffness);
  EXPECT_DOUBLE_EQ(problem.sliding_velocity / problem.drive_amplitude, known.sliding_velocity);
  EXPECT_EQ(problem.periods, 100);
}

TEST(ProblemTest, CarriesInitialStateSignAndDamping) {
  scene::Scene scene = table_1();
  const double length_m = 1e-7;
  scene.plant.initial_displacement_m = length_m;
  scene.plant.damping_N_s_per_m = 100.0;
  scene.friction.initial_force_N = 0.5 * 0.01962;
  scene.friction.sign_convention = scene::SignConvention::as_printed;
  const peers::Problem problem = problem_of(scene);
  EXPECT_EQ(problem.vibration_sign, -1.0);
  EXPECT_DOUBLE_EQ(problem.friction, 0.5);
  EXPECT_GT(problem.displacement, 0.0);
  EXPECT_DOUBLE_EQ(problem.damping, 100.0 / (0.02 * 60e3 * peers::carrier_period));
}

TEST(ProblemTest, RefusesByName) {
  scene::Scene closed_loop = table_1();
  closed_loop.controller.emplace();
  EXPECT_EQ(refused_key(closed_loop), "controller");

  scene::Scene no_drive = table_1();
  no_drive.drive.reset();
  EXPECT_EQ(refused_key(no_drive), "drive");

  scene::Scene coulomb = table_1();
  coulomb.friction.law = scene::laws::Coulomb{};
  EXPECT_EQ(refused_key(coulomb), "friction.law");

  scene::Scene no_friction = table_1();
  no_friction.friction.coefficient = 0.0;
  EXPECT_EQ(refused_key(no_friction), "friction.coefficient");

  scene::Scene ramp = table_1();
  ramp.sliding.profile.push_back({1e-3, 0.0});
  EXPECT_EQ(refused_key(ramp), "sliding.profile");

  scene::Scene moving = table_1();
  moving.friction.coefficient_profile = {{0.0, 0.1}, {1e-3, 0.2}};
  EXPECT_EQ(refused_key(moving), "friction.coefficient_profile");

  for (const double periods : {0.5, 2.5, 1001.0}) {
    scene::Scene odd = table_1();
    odd.run.duration_s = periods / 60e3;
    EXPECT_EQ(refused_key(odd), "run") << periods;
  }
}

}  // namespace
}  // namespace sonoglide::work_precision::problem_test
