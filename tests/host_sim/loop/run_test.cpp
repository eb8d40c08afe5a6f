#include "host_sim/loop/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "tests/common/table_1.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::loop::run_test {
namespace {

using scene::Scene;
using tests::carrier_Hz;
using tests::period_s;
using tests::pi;
using tests::table_1;
using tests::table_1_closed_loop;

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

void expect_same_motion(const LoggedRun& logged_a, const LoggedRun& logged_b) {
  const RunResult& a = logged_a.result;
  const RunResult& b = logged_b.result;
  EXPECT_TRUE(same_bits(a.final_state.displacement_m, b.final_state.displacement_m));
  EXPECT_TRUE(same_bits(a.final_state.velocity_m_per_s, b.final_state.velocity_m_per_s));
  EXPECT_TRUE(same_bits(a.final_state.friction_force_N, b.final_state.friction_force_N));
  EXPECT_EQ(a.solver_steps, b.solver_steps);
  EXPECT_EQ(a.solver_events, b.solver_events);
  ASSERT_EQ(logged_a.periods.size(), logged_b.periods.size());
  for (std::size_t i = 0; i < logged_a.periods.size(); ++i) {
    ASSERT_TRUE(same_bits(logged_a.periods[i].friction_ratio, logged_b.periods[i].friction_ratio))
        << i;
  }
}

Scene recording(Scene scene, double interval_s) {
  scene.run.record = {scene::Channel::displacement};
  scene.run.record_interval_s = interval_s;
  return scene;
}

TEST(RunTest, APeriodThatIsCutShortHasNoFrictionRatio) {
  Scene scene = table_1_closed_loop();
  scene.run.duration_s = 10.25 * period_s;
  const std::vector<Period> periods = run_logged(scene).periods;
  ASSERT_EQ(periods.size(), 11U);
  for (const Period& period : periods) {
    EXPECT_EQ(std::isnan(period.friction_ratio), !period.whole) << period.begin_s;
  }
  EXPECT_FALSE(periods.back().whole);
}

TEST(RecordingTest, DoesNotChangeABitOfAnOpenLoop) {
  for (const double tolerance : {1e-4, 1e-10, 1e-13}) {
    Scene scene = table_1();
    scene.solver.tolerance = tolerance;
    const LoggedRun silent = run_logged(scene);
    for (const double interval_s : {1e-3, 1e-6, 7.3e-8}) {
      expect_same_motion(run_logged(recording(scene, interval_s)), silent);
    }
  }
}

TEST(RecordingTest, DoesNotChangeABitOfAClosedLoop) {
  for (const scene::Arithmetic arithmetic :
       {scene::Arithmetic::float64, scene::Arithmetic::float32, scene::Arithmetic::q31}) {
    const Scene scene = table_1_closed_loop(arithmetic);
    const LoggedRun silent = run_logged(scene);
    for (const double interval_s : {1e-3, 1e-6, 7.3e-8}) {
      const LoggedRun recorded = run_logged(recording(scene, interval_s));
      expect_same_motion(recorded, silent);
      EXPECT_EQ(recorded.result.control->trace_hash, silent.result.control->trace_hash);
    }
  }
}

TEST(RecordingTest, NobodyWatchingChangesNothing) {
  const Scene scene = recording(table_1_closed_loop(), 1e-6);
  const RunResult unwatched = run(scene);
  const LoggedRun watched = run_logged(scene);
  EXPECT_TRUE(
      same_bits(unwatched.final_state.displacement_m, watched.result.final_state.displacement_m));
  EXPECT_TRUE(same_bits(unwatched.whole.drive_work_J, watched.result.whole.drive_work_J));
  EXPECT_TRUE(
      same_bits(unwatched.window.stored_integral_J_s, watched.result.window.stored_integral_J_s));
  EXPECT_EQ(unwatched.control->trace_hash, watched.result.control->trace_hash);
}

TEST(RecordingTest, OfTheWholeRunHasBothEnds) {
  const LoggedRun logged = run_logged(recording(table_1_closed_loop(), 1e-6));
  const RunResult& result = logged.result;
  const Recording& trace = logged.trace;
  ASSERT_EQ(trace.time_s.size(), 2001U);
  EXPECT_EQ(trace.time_s.front(), 0.0);
  EXPECT_NEAR(trace.time_s.back(), 2e-3, 1e-15);
  EXPECT_EQ(trace.state.front().displacement_m, 0.0);
  const auto same_but_for_the_times_rounding = [](double a, double b) {
    EXPECT_NEAR(a, b, 1e-12 * std::abs(b));
  };
  same_but_for_the_times_rounding(trace.state.back().displacement_m,
                                  result.final_state.displacement_m);
  same_but_for_the_times_rounding(trace.state.back().friction_force_N,
                                  result.final_state.friction_force_N);
}

TEST(RecordingTest, HasTheSameStatesHoweverDense) {
  const Scene scene = table_1();
  const LoggedRun coarse = run_logged(recording(scene, 4e-6));
  const LoggedRun fine = run_logged(recording(scene, 1e-6));
  ASSERT_EQ(coarse.trace.state.size(), 417U) << "a hundred carrier periods, 4 us apart";
  for (std::size_t i = 0; i < coarse.trace.state.size(); ++i) {
    EXPECT_NEAR(coarse.trace.state[i].displacement_m, fine.trace.state[4 * i].displacement_m,
                1e-18);
  }
}

TEST(RecordingTest, ShowsDriveForceAndSlidingVelocity) {
  Scene scene = recording(table_1(), 1e-6);
  scene.sliding.profile = {{0.0, 0.01}, {1e-3, 0.03}};
  const Recording trace = run_logged(scene).trace;
  for (std::size_t i = 0; i < trace.time_s.size(); ++i) {
    const double t = trace.time_s[i];
    EXPECT_NEAR(trace.drive_force_N[i], 384.0 * std::cos(2.0 * pi * carrier_Hz * t), 1e-8);
    EXPECT_NEAR(trace.sliding_velocity_m_per_s[i], t < 1e-3 ? 0.01 + 20.0 * t : 0.03, 1e-15);
  }
}

TEST(RunTest, TheWindowIsTheRunFromItsStart) {
  Scene scene = table_1();
  scene.run.window_start_s = 0.0;
  const RunResult all = run(scene);
  EXPECT_EQ(all.window.friction_work_J, all.whole.friction_work_J);
  scene.run.window_start_s = 33.3e-6;  // inside a carrier period
  const RunResult part = run(scene);
  EXPECT_NEAR(part.window.duration_s, scene.run.duration_s - 33.3e-6, 1e-15);
  EXPECT_NEAR(part.whole.duration_s, scene.run.duration_s, 1e-15);
}

TEST(RunTest, PeriodsTileTheRun) {
  Scene scene = table_1_closed_loop();
  scene.run.duration_s = 77.4 * period_s;
  const LoggedRun logged = run_logged(scene);
  ASSERT_EQ(logged.periods.size(), 78U);
  EXPECT_EQ(logged.periods.front().begin_s, 0.0);
  for (std::size_t i = 1; i < logged.periods.size(); ++i) {
    EXPECT_EQ(logged.periods[i].begin_s, logged.periods[i - 1].end_s);
  }
  EXPECT_EQ(logged.periods.back().end_s, scene.run.duration_s);
  EXPECT_EQ(logged.result.control->commands, 77U) << "one command for each whole carrier period";
}

TEST(RunTest, TheMeanOfThePeriodsIsThatOfTheRun) {
  const Scene scene = table_1();
  const LoggedRun logged = run_logged(scene);
  double sum = 0.0;
  for (const Period& period : logged.periods) {
    sum += period.friction_ratio;
  }
  const double whole =
      logged.result.whole.resistance_impulse_N_s / (0.01962 * logged.result.whole.duration_s);
  EXPECT_NEAR(sum / static_cast<double>(logged.periods.size()), whole, 1e-12);
}

// A target is set with the sample that ends at its time; the answer acts a latency later.
TEST(RunTest, ACommandActsAfterTheLatencyAndATargetFromItsTimeOn) {
  for (const int latency : {0, 1, 3}) {
    Scene scene = table_1_closed_loop();
    scene.drive->delay_periods = latency;
    const LoggedRun logged = run_logged(scene);
    const auto late = static_cast<std::size_t>(latency);
    for (std::size_t i = 0; i <= late; ++i) {
      EXPECT_EQ(logged.periods[i].drive_amplitude_N, 0.0);
      EXPECT_TRUE(std::isnan(logged.periods[i].target));
    }
    for (std::size_t i = late + 1; i < logged.periods.size(); ++i) {
      EXPECT_EQ(logged.periods[i].target, i < 60 + late ? 0.4 : 0.6) << i;
    }
    EXPECT_NE(logged.periods[60 + late].drive_amplitude_N,
              logged.periods[59 + late].drive_amplitude_N);
  }
}

/// Ends a run in its hundredth carrier period.
struct Quitter final : PeriodSink {
  int seen = 0;
  void take(const Period& /*period*/) override {
    if (++seen == 100) {
      throw std::runtime_error("enough");
    }
  }
};

TEST(RunTest, WhatASinkThrowsEndsIt) {
  Quitter quitter;
  Watch watch;
  watch.periods = {&quitter};
  EXPECT_THROW(run(table_1_closed_loop(), watch), std::runtime_error);
  EXPECT_EQ(quitter.seen, 100);
}

TEST(RunTest, SaysHowFarItIs) {
  std::vector<double> seen;
  Watch watch;
  watch.progress = [&seen](double fraction) { seen.push_back(fraction); };
  run(table_1(), watch);
  ASSERT_GT(seen.size(), 10U);
  for (std::size_t i = 1; i < seen.size(); ++i) {
    EXPECT_GT(seen[i], seen[i - 1]);
  }
  EXPECT_EQ(seen.front(), 0.0);
  EXPECT_LE(seen.back(), 1.0);
}

TEST(RunTest, SlewLimitHoldsForTheShapedDrive) {
  for (const double slew_N_per_s : {1e6, 5e6, 2e7}) {
    Scene scene = table_1_closed_loop();
    scene.drive->max_force_slew_N_per_s = slew_N_per_s;
    const LoggedRun logged = run_logged(scene);
    double fastest_N = 0.0;
    for (std::size_t i = 1; i < logged.periods.size(); ++i) {
      fastest_N = std::max(fastest_N, std::abs(logged.periods[i].drive_amplitude_N -
                                               logged.periods[i - 1].drive_amplitude_N));
    }
    EXPECT_LE(fastest_N, slew_N_per_s * period_s * (1.0 + 1e-6));
    EXPECT_GE(fastest_N, 0.3 * slew_N_per_s * period_s);
    EXPECT_EQ(logged.periods[2].limit, control::Limit::slew);
  }
}

TEST(RunTest, OnlyFixedPointHasSignals) {
  EXPECT_TRUE(run(table_1_closed_loop()).control->signals.empty());
  const RunResult fixed = run(table_1_closed_loop(scene::Arithmetic::q31));
  ASSERT_FALSE(fixed.control->signals.empty());
  for (const numeric::SignalRecord& signal : fixed.control->signals) {
    EXPECT_EQ(signal.saturations, 0U) << signal.name;
    EXPECT_LE(signal.smallest, signal.largest);
  }
}

}  // namespace
}  // namespace sonoglide::loop::run_test
