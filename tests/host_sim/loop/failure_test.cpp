#include <gtest/gtest.h>

#include <string>

#include "host_sim/configure/solver_methods.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::loop::failure_test {
namespace {

using tests::period_s;
using tests::table_1;
using tests::table_1_closed_loop;

std::string failure(const scene::Scene& scene) {
  try {
    run(scene);
  } catch (const ComputationError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

void expect_time_and_state(const std::string& message) {
  EXPECT_EQ(message.rfind("solver: at ", 0), 0U) << message;
  for (const char* part : {" s, displacement ", " m, velocity ", " m/s, friction force ", " N: "}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
  }
}

scene::Scene with_rk4(double contact_stiffness_N_per_m) {
  scene::Scene scene = table_1();
  scene.friction.contact_stiffness_N_per_m = contact_stiffness_N_per_m;
  scene.solver.method = configure::method_of<configure::solvers::Rk4>;
  scene.solver.step_s = 1.667e-8;
  return scene;
}

TEST(FailureTest, AContactTooStiffForTheStepIsNamed) {
  // The paper's step is stable up to 7.9e7 N/m.
  const std::string message = failure(with_rk4(1e9));
  expect_time_and_state(message);
  EXPECT_NE(message.find("|F| > Fc, the step is too long for the contact stiffness"),
            std::string::npos)
      << message;
}

TEST(FailureTest, AFailureDuringALoopIsOneToo) {
  scene::Scene scene = table_1_closed_loop();
  scene.friction.contact_stiffness_N_per_m = 1e9;
  scene.solver = with_rk4(1e9).solver;
  expect_time_and_state(failure(scene));
}

TEST(FailureTest, TimeIsThatOfTheRunNotOfTheStretch) {
  scene::Scene scene = with_rk4(1e9);
  scene.sliding.profile = {{0.0, 0.0}, {10.0 * period_s, 0.0}, {11.0 * period_s, 0.5}};
  scene.drive->force_amplitude_N = 0.0;
  const std::string message = failure(scene);
  const double time_s = std::stod(message.substr(std::string("solver: at ").size()));
  EXPECT_GT(time_s, 10.0 * period_s) << message;
  EXPECT_LT(time_s, 12.0 * period_s) << message;
}

TEST(FailureTest, StepsThatRunOutAreNamedWithTheirCost) {
  scene::Scene scene = with_rk4(1e9);
  scene.solver.step_s = 1e-12;
  const std::string message = failure(scene);
  expect_time_and_state(message);
  // sqrt((1e9 + 133e6) / 0.02) / 2π = 37.88 kHz.
  for (const char* part : {"more than 1000000 steps in one carrier period, 0 since the run began",
                           "a stuck contact rings at sqrt((Kt + Ks)/m)/2π = 3.788e+04 Hz",
                           "under a drive of 6e+04 Hz"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
  }
}

TEST(FailureTest, AContactThatIsSoftEnoughRuns) {
  EXPECT_EQ(failure(with_rk4(0.056e6)), "nothing was thrown");
}

}  // namespace
}  // namespace sonoglide::loop::failure_test
