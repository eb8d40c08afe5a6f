/// A load in SI units: closed forms, limits, the closed loop, and a start in the middle.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/stepped.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::loop::load_test {
namespace {

using tests::period_s;
using tests::table_1;
using tests::table_1_closed_loop;

scene::Scene with_load(scene::Scene scene, const scene::Load& load) {
  scene.load = load;
  scene.sliding.profile = {{0.0, load.fastest_m_per_s()}};
  return scene;
}

scene::Load moving(double mass_kg, double velocity_m_per_s) {
  scene::Load load;
  load.mass_kg = mass_kg;
  load.initial_velocity_m_per_s = velocity_m_per_s;
  return load;
}

/// A spring that pulls at a constant velocity, a damper, and a force that jumps.
scene::Load pulled(double mass_kg, double velocity_m_per_s) {
  scene::Load load = moving(mass_kg, velocity_m_per_s);
  load.spring_N_per_m = 200.0;
  load.pull_profile_m_per_s = {{0.0, velocity_m_per_s}, {1e-3, 0.9 * velocity_m_per_s}};
  load.damping_N_s_per_m = 0.05;
  load.force_profile_N = {{0.0, 0.004}, {7e-4, 0.004}, {7e-4, 0.001}};
  return load;
}

double table_1_speed_m_per_s() {
  return table_1().sliding.profile.front().velocity_m_per_s;
}

/// Without a drive the body falls by μN/M a second, and then stands for good.
TEST(LoadSceneTest, StopsForGood) {
  scene::Scene scene = with_load(table_1(), moving(0.1, 0.01));
  scene.drive.reset();
  scene.friction.law = scene::laws::Coulomb{};
  scene.plant.damping_N_s_per_m = 2.0 * std::sqrt(133e6 * 0.02);  // aperiodic
  const double stop_s = 0.01 * 0.1 / tests::Table1::friction_limit_N;
  scene.run.duration_s = 2.0 * stop_s;
  scene.run.window_start_s = 1.5 * stop_s;
  scene.run.record = {scene::Channel::sliding_velocity, scene::Channel::load_displacement};
  scene.run.record_interval_s = 0.1 * stop_s;
  const LoggedRun run = run_logged(scene);
  for (std::size_t i = 0; i < run.trace.time_s.size(); ++i) {
    const double time_s = std::fmin(run.trace.time_s[i], stop_s);
    EXPECT_NEAR(run.trace.sliding_velocity_m_per_s[i], 0.01 * (1.0 - time_s / stop_s), 1e-9);
    EXPECT_NEAR(run.trace.load_displacement_m[i], 0.01 * (time_s - 0.5 * time_s * time_s / stop_s),
                1e-9);
  }
  EXPECT_EQ(run.result.final_load_displacement_m, run.trace.load_displacement_m.back());
  // The body slides at its limit until it stands, and there is no ratio then.
  EXPECT_NEAR(run.periods[100].friction_ratio, 1.0, 1e-12);
  EXPECT_TRUE(std::isnan(run.periods.back().friction_ratio));
  EXPECT_TRUE(std::isnan(power_ratios(scene, run.result.window).friction_ratio));
  EXPECT_NEAR(power_ratios(scene, run.result.whole).friction_ratio, 1.0, 1e-3);
}

/// A body of a thousand tons slides as one whose velocity is given.
TEST(LoadSceneTest, AHeavyBodySlidesAsItIsGiven) {
  const scene::Scene given = table_1();
  const scene::Scene heavy = with_load(given, moving(1e6, table_1_speed_m_per_s()));
  EXPECT_NEAR(power_ratios(heavy, run(heavy).whole).friction_ratio,
              power_ratios(given, run(given).whole).friction_ratio, 2e-9);
}

/// dVt/dt = −Fc ρ(Vt/v̂, κ)/M, by the closed form and the formula of Heun.
TEST(LoadSceneTest, IsBrakedByTheFrictionRatio) {
  const double mass_kg = 2.0;
  scene::Scene scene =
      tests::on_steady_orbit(with_load(table_1(), moving(mass_kg, table_1_speed_m_per_s())));
  scene.run.duration_s = 0.5;
  scene.run.window_start_s = 0.0;
  scene.solver.tolerance = 1e-7;
  const double vibration_m_per_s = tests::vibration_velocity_m_per_s(scene.plant, 384.0);
  const double limit_N = tests::Table1::friction_limit_N;
  const double dahl_number = tests::Table1::contact_stiffness_N_per_m * vibration_m_per_s /
                             (2.0 * tests::pi * tests::carrier_Hz * limit_N);
  const auto braked = [&](double velocity_m_per_s) {
    return -limit_N / mass_kg *
           friction::dahl_friction_ratio(velocity_m_per_s / vibration_m_per_s, dahl_number);
  };
  double velocity_m_per_s = table_1_speed_m_per_s();
  const int steps = 500;
  for (int i = 0; i < steps; ++i) {
    const double step_s = scene.run.duration_s / steps;
    const double first = braked(velocity_m_per_s);
    velocity_m_per_s += 0.5 * step_s * (first + braked(velocity_m_per_s + step_s * first));
  }
  const double fall = table_1_speed_m_per_s() - velocity_m_per_s;
  const RunResult result = run(scene);
  EXPECT_NEAR((table_1_speed_m_per_s() - result.final_state.load_velocity_m_per_s) / fall, 1.0,
              2e-3);
}

TEST(LoadSceneTest, BalancesTheEnergyOfBothBodies) {
  for (const scene::FrictionLaw& law :
       {scene::FrictionLaw(scene::laws::Dahl{}), scene::FrictionLaw(scene::laws::Coulomb{}),
        scene::FrictionLaw(scene::laws::Stribeck{0.75, 100.0}),
        scene::FrictionLaw(scene::laws::Iwan{3})}) {
    scene::Scene scene = with_load(table_1(), pulled(0.05, table_1_speed_m_per_s()));
    scene.friction.law = law;
    scene.plant.damping_N_s_per_m = 5.0;
    scene.solver.tolerance = 1e-12;
    const RunResult result = run(scene);
    const EnergyBalance& whole = result.whole;
    EXPECT_LE(std::abs(power_ratios(scene, whole).balance_residual), 1e-9);
    EXPECT_NEAR(whole.pull_work_J,
                whole.load.force_work_J + whole.load.spring_pull_work_J -
                    whole.load.damping_work_J - whole.load.change_J(),
                1e-9 * std::abs(whole.load.stored_begin_J));
    EXPECT_NE(whole.load.force_work_J, 0.0);
    EXPECT_NE(whole.load.spring_pull_work_J, 0.0);
  }
}

/// A load on a spring, next to without friction: x = (v0/ω) sin ωt goes 2/π v0 t, however a step holds its turns.
TEST(LoadSceneTest, GoesTheDistanceOfALoadThatTurns) {
  for (const double frequency_Hz : {500.0, 7e3, 20e3, 60e3}) {
    for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
      scene::Load load = moving(1.0, 0.01);
      const double omega = numeric::two_pi * frequency_Hz;
      load.spring_N_per_m = omega * omega;
      scene::Scene scene = with_load(table_1(), load);
      scene.friction.law = scene::laws::Coulomb{};
      scene.friction.normal_force_N = 1e-9;
      scene.drive->frequency_Hz = 20e3;
      scene.solver.tolerance = tolerance;
      scene.run.duration_s = 5e-3;
      scene.run.window_start_s = 0.0;
      const double exact_m = 2.0 / numeric::half_turn * 0.01 * scene.run.duration_s;
      EXPECT_NEAR(run(scene).window.sliding_distance_m / exact_m, 1.0, 10.0 * tolerance)
          << frequency_Hz << " " << tolerance;
    }
  }
}

/// A carrier period in which a load turns has no friction ratio, into however many stretches it is cut.
TEST(LoadSceneTest, LeavesOutTheWholePeriodOfATurn) {
  scene::Load load = moving(0.01, 0.003);
  load.force_profile_N = {{0.0, -0.4}, {1.0, -0.4}};
  scene::Scene scene = with_load(table_1(), load);
  scene.drive->force_amplitude_N = 400.0;
  scene.run.duration_s = 12.0 * period_s;
  scene.run.window_start_s = 0.0;
  const auto ratio = [](const scene::Scene& cut) {
    const RunResult result = run(cut);
    EXPECT_DOUBLE_EQ(result.window.undriven_s, result.whole.undriven_s);
    return power_ratios(cut, result.window).friction_ratio;
  };
  const double expected = ratio(scene);
  EXPECT_TRUE(std::isfinite(expected));
  for (int row = 1; row < 20; ++row) {
    scene.load->force_profile_N = {{0.0, -0.4}, {row * 0.5 * period_s, -0.4}, {1.0, -0.4}};
    EXPECT_NEAR(ratio(scene), expected, 1e-9) << row;
  }
}

TEST(LoadSceneTest, BothSolversAgree) {
  scene::Scene scene = with_load(table_1(), pulled(0.05, table_1_speed_m_per_s()));
  const RunResult taylor = run(scene);
  scene.solver.method = scene::method_of<scene::solvers::Rk4>;
  scene.solver.step_s = 2e-9;
  const RunResult fixed = run(scene);
  EXPECT_NEAR(fixed.final_state.load_velocity_m_per_s / taylor.final_state.load_velocity_m_per_s,
              1.0, 1e-8);
  EXPECT_NEAR(fixed.final_load_displacement_m / taylor.final_load_displacement_m, 1.0, 1e-8);
}

TEST(LoadSceneTest, EveryWaveformDrivesTheMassUnderIt) {
  for (const scene::Waveform waveform :
       {scene::Waveform::square, scene::Waveform::triangle, scene::Waveform::sawtooth}) {
    scene::Scene scene = with_load(table_1(), pulled(0.05, table_1_speed_m_per_s()));
    scene.drive->waveform = waveform;
    scene.solver.order = 16;
    scene::Scene other = scene;
    other.solver.order.reset();
    other.solver.method = scene::method_of<scene::solvers::Rk4>;
    other.solver.step_s = 2e-9;
    EXPECT_NEAR(
        run(other).final_state.load_velocity_m_per_s / run(scene).final_state.load_velocity_m_per_s,
        1.0, 1e-6);
  }
}

/// The controller knows the velocity of the body at the end of each period.
TEST(LoadSceneTest, AClosedLoopHoldsItsTargets) {
  const scene::Scene scene = with_load(table_1_closed_loop(), pulled(0.05, 0.02672));
  const LoggedRun logged = run_logged(scene);
  EXPECT_TRUE(logged.result.control->faults.empty());
  EXPECT_NEAR(logged.periods[58].friction_ratio, 0.4, 0.01);
  EXPECT_NEAR(logged.periods.back().friction_ratio, 0.6, 0.01);
  EXPECT_LT(logged.result.final_state.load_velocity_m_per_s, 0.0267);
}

/// From a snapshot a loop goes on bit for bit; an added force is felt.
TEST(LoadSceneTest, IsSteppedFromOutside) {
  const configure::Experiment experiment =
      configure::make_experiment(with_load(table_1_closed_loop(), pulled(0.05, 0.02672)));
  SteppedScene one(experiment, Kind::loop);
  const Inputs inputs;
  for (int i = 0; i < 20; ++i) {
    one.advance(inputs);
  }
  StateCopy writer;
  one.copy_state(writer);
  const Snapshot snapshot = writer.take();
  SteppedScene other(experiment, Kind::loop);
  StateCopy reader(snapshot);
  other.copy_state(reader);
  for (int i = 0; i < 20; ++i) {
    one.advance(inputs);
    other.advance(inputs);
  }
  EXPECT_EQ(one.plant().sliding_velocity_m_per_s, other.plant().sliding_velocity_m_per_s);
  EXPECT_EQ(one.plant().load_displacement_m, other.plant().load_displacement_m);
  EXPECT_EQ(one.controller().trace_hash, other.controller().trace_hash);
  Inputs pushed;
  pushed.load_force_N = 1.0;
  one.advance(pushed);
  other.advance(inputs);
  EXPECT_NEAR(one.plant().sliding_velocity_m_per_s - other.plant().sliding_velocity_m_per_s,
              pushed.load_force_N * period_s / 0.05, 1e-6);
}

}  // namespace
}  // namespace sonoglide::loop::load_test
