#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/loop/run.hpp"
#include "host_sim/scene/solver_methods.hpp"
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
  scene.solver.method = scene::method_of<scene::solvers::Rk4>;
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
  for (const char* part : {"one carrier period needs more than 1000000 steps (0 were taken",
                           "solver.step_s = 1e-12 cuts it into 1.667e+07"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
  }
}

/// A plant whose carrier is so slow that `rate` alone needs more steps than there may be.
struct Cause {
  double stiffness_N_per_m;
  double damping_N_s_per_m;
  double contact_stiffness_N_per_m;
  std::string told;
};

TEST(FailureTest, TheTrueCauseOfManyStepsIsNamed) {
  // A kilogram, driven at 1 Hz: sqrt(1e15) / 2π = 5.033 MHz.
  const std::vector<Cause> causes = {
      {1e15, 0.0, 1e13, "the natural mode, sqrt(Ks/m)/2π = 5.033e+06 Hz, turns 5.033e+06 times"},
      {1.0, 0.0, 1e15, "a stuck contact rings at sqrt((Kt + Ks)/m)/2π = 5.033e+06 Hz"},
      {1.0, 1e8, 1e10, "the damper stops the mass within m/c = 1e-08 s"}};
  for (const Cause& cause : causes) {
    scene::Scene scene = table_1();
    scene.plant.mass_kg = 1.0;
    scene.plant.stiffness_N_per_m = cause.stiffness_N_per_m;
    scene.plant.damping_N_s_per_m = cause.damping_N_s_per_m;
    scene.friction.contact_stiffness_N_per_m = cause.contact_stiffness_N_per_m;
    scene.friction.normal_force_N = 1e4;
    scene.drive->frequency_Hz = 1.0;
    scene.drive->force_amplitude_N = 10.0;
    scene.sliding.profile = {{0.0, 1e-9}};
    scene.run.duration_s = 3.0;
    scene.run.window_start_s = 0.0;
    const std::string message = failure(scene);
    EXPECT_NE(message.find(cause.told), std::string::npos) << message;
  }
}

TEST(FailureTest, AContactAcrossTheSlidingThatComesToRestIsNamed) {
  scene::Scene scene = table_1();
  scene.friction.law = scene::laws::TransverseCoulomb{};
  scene.friction.normal_force_N = 20.0;
  scene.drive->force_amplitude_N = 0.0;
  scene.plant.initial_velocity_m_per_s = 0.01;
  scene.sliding.profile = {{0.0, 0.02}, {1e-3, -0.02}};
  const std::string message = failure(scene);
  EXPECT_NE(message.find("the contact comes to rest, with sliding and vibration at 0 together"),
            std::string::npos)
      << message;
}

TEST(FailureTest, ALoadsDamperThatIsTooFastIsNamed) {
  scene::Scene scene = table_1();
  scene.sliding = {};
  scene.load.emplace();
  scene.load->mass_kg = 1.0;
  scene.load->damping_N_s_per_m = 1e12;
  scene.load->initial_velocity_m_per_s = 0.01;
  const std::string message = failure(scene);
  EXPECT_NE(message.find("the damper of the load stops it within M/c = 1e-12 s"), std::string::npos)
      << message;
}

/// What a step of rk4_event passes over, and a solver that would not.
struct LongStep {
  double stiffness_N_per_m;
  double contact_stiffness_N_per_m;
  double normal_force_N;
  std::string told;
};

TEST(FailureTest, TheTrueCauseOfATooLongStepIsNamed) {
  // A step of 1e-7 s, 20 g: Ks 8/h^2 m = 1.6e13 N/m, Kt m/h^2 = 2e12 N/m; Fc 0.1 N.
  const std::vector<LongStep> steps = {
      {2e13, 1e6, 1.0, "the natural mode, sqrt(Ks/m)/2π = 5.033e+06 Hz"},
      {133e6, 3e12, 1.0, "a stuck contact rings at sqrt((Kt + Ks)/m)/2π = 1.949e+06 Hz"},
      {133e6, 1e8, 1.0, "the contact slides more than Fc/(2 Kt) = 5e-10 m in one step"}};
  for (const LongStep& step : steps) {
    scene::Scene scene = table_1();
    scene.plant.stiffness_N_per_m = step.stiffness_N_per_m;
    scene.friction.contact_stiffness_N_per_m = step.contact_stiffness_N_per_m;
    scene.friction.normal_force_N = step.normal_force_N;
    scene.solver.method = scene::method_of<scene::solvers::Rk4Event>;
    scene.solver.step_s = 1e-7;
    const std::string message = failure(scene);
    expect_time_and_state(message);
    EXPECT_NE(message.find("the step is too long: " + step.told), std::string::npos) << message;
    EXPECT_NE(message.find("a shorter solver.step_s would do, or event_taylor"), std::string::npos);
    scene.run.start = scene::Start::steady;
    const std::string orbit = failure(scene);
    EXPECT_NE(orbit.find("the solver fails in them, the step is too long: " + step.told),
              std::string::npos)
        << orbit;
  }
}

TEST(FailureTest, AToleranceOutOfReachOfSecondOrderIsNamed) {
  scene::Scene scene = table_1();
  scene.friction.normal_force_N = 1e3;
  scene.solver.method = scene::method_of<scene::solvers::Strang>;
  scene.solver.tolerance = 1e-15;
  const std::string message = failure(scene);
  expect_time_and_state(message);
  EXPECT_NE(message.find("solver.tolerance = 1e-15 asks for them of strang, which is of second "
                         "order; event_taylor takes fewer"),
            std::string::npos)
      << message;
}

/// No friction: the oscillator is linear, whatever the ratio of its frequencies.
TEST(FailureTest, AMilligramOnAGiganewtonPerMetreRuns) {
  scene::Scene scene = table_1();
  scene.friction.law = scene::laws::None{};
  scene.plant.mass_kg = 1e-6;
  scene.plant.stiffness_N_per_m = 1e9;
  scene.drive->frequency_Hz = 10.0;
  scene.drive->force_amplitude_N = 1.0;
  scene.run.duration_s = 0.3;
  scene.run.window_start_s = 0.0;
  const RunResult result = run(scene);
  EXPECT_EQ(result.solver_steps, 3U);
  // A/(Ks - m w^2) (cos(w t) - cos(wn t)).
  const double w = 20.0 * tests::pi;
  const double amplitude_m = 1.0 / (1e9 - 1e-6 * w * w);
  const long double turned = std::sqrt(1e15L) * 0.3L;
  EXPECT_NEAR(result.final_state.displacement_m,
              amplitude_m * (1.0 - static_cast<double>(std::cos(turned))), 1e-8 * amplitude_m);
}

/// Nothing moves at first but what the friction sets in motion.
TEST(FailureTest, StrangSetsOutFromRestWithoutADrive) {
  scene::Scene scene = table_1();
  scene.plant.mass_kg = 3e-3;
  scene.plant.stiffness_N_per_m = 30e6;
  scene.plant.damping_N_s_per_m = 4.0;
  scene.friction.contact_stiffness_N_per_m = 20e3;
  scene.friction.normal_force_N = 2.0;
  scene.sliding.profile = {{0.0, 0.4}};
  scene.drive->frequency_Hz = 20e3;
  scene.drive->force_amplitude_N = 0.0;
  scene.run.duration_s = 50.0 / 20e3;
  scene.run.window_start_s = 0.0;
  const RunResult reference = run(scene);
  scene.solver.method = scene::method_of<scene::solvers::Strang>;
  const double reference_m = reference.final_state.displacement_m;
  for (const auto& [tolerance, error] : {std::pair{1e-4, 2e-2}, std::pair{1e-6, 5e-4}}) {
    scene.solver.tolerance = tolerance;
    const RunResult result = run(scene);
    EXPECT_NEAR(result.final_state.displacement_m, reference_m, error * std::abs(reference_m))
        << tolerance;
    EXPECT_NEAR(result.final_state.friction_force_N, reference.final_state.friction_force_N, 1e-4);
  }
}

TEST(FailureTest, AContactThatIsSoftEnoughRuns) {
  EXPECT_EQ(failure(with_rk4(0.056e6)), "nothing was thrown");
}

}  // namespace
}  // namespace sonoglide::loop::failure_test
