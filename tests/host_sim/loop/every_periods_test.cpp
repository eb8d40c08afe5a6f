// Controllers that step once in several carrier periods, against a loop that is put together here of a plant
// and a controller: the sample of every n-th period, its answer held until the next one acts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include "firmware/numeric/scalar.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/control/sensor.hpp"
#include "host_sim/loop/stepped.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::loop::every_periods_test {
namespace {

using scene::Arithmetic;
using tests::period_s;

constexpr std::size_t periods = 400;

/// The second of two targets begins in the middle.
scene::Scene loop_of(Arithmetic arithmetic, int every_periods, std::size_t of_periods = periods) {
  scene::Scene scene = tests::table_1_closed_loop(arithmetic);
  scene.controller->every_periods = every_periods;
  scene.controller->target_friction_ratio = {
      {0.0, 0.4}, {0.5 * static_cast<double>(of_periods) * period_s, 0.6}};
  scene.run.duration_s = static_cast<double>(of_periods) * period_s;
  return scene;
}

/// Amplitude of each carrier period.
std::vector<double> amplitudes_by_hand(const scene::Scene& scene) {
  const configure::Experiment experiment = configure::make_experiment(scene);
  SteppedScene plant(experiment, Kind::plant);
  const auto controller = make_control_port(scene, *experiment.design);
  Sensor sensor({}, experiment.design->scales);
  std::deque<double> means_N(static_cast<std::size_t>(scene.sensor.delay_periods), 0.0);
  std::deque<double> answers_N(static_cast<std::size_t>(scene.drive->delay_periods), 0.0);
  const auto& targets = scene.controller->target_friction_ratio;
  std::vector<double> amplitudes_N;
  double in_force_N = 0.0;
  double answer_N = 0.0;
  std::size_t next_target = 0;
  for (int k = 0; k < static_cast<int>(periods); ++k) {
    Inputs inputs;
    inputs.drive_force_amplitude_N = in_force_N;
    plant.advance(inputs);
    amplitudes_N.push_back(in_force_N);
    means_N.push_back(plant.plant().mean_friction_force_N);
    if ((k + 1) % scene.controller->every_periods == 0) {
      for (; next_target < targets.size() &&
             targets[next_target].time_s < (k + 1) * period_s + 1e-9 * period_s;
           ++next_target) {
        controller->set_target(targets[next_target].value);
      }
      const hal::Drive drive = controller->exchange(
          sensor.sample(means_N.front(), plant.plant().sliding_velocity_m_per_s));
      answer_N = numeric::from_code<double>(drive.amplitude) * scene.max_drive_force_N();
    }
    means_N.pop_front();
    answers_N.push_back(answer_N);
    in_force_N = answers_N.front();
    answers_N.pop_front();
  }
  return amplitudes_N;
}

TEST(EveryPeriodsTest, IsTheLoopOfEveryNthSample) {
  for (const int every : {1, 2, 3, 7, 16}) {
    for (const int drive_delay : {0, 1, 3}) {
      for (const int sensor_delay : {0, 2}) {
        scene::Scene scene = loop_of(Arithmetic::float32, every);
        scene.drive->delay_periods = drive_delay;
        scene.sensor.delay_periods = sensor_delay;
        const LoggedRun logged = run_logged(scene);
        const std::vector<double> expected = amplitudes_by_hand(scene);
        ASSERT_EQ(logged.periods.size(), expected.size());
        for (std::size_t k = 0; k < expected.size(); ++k) {
          ASSERT_EQ(logged.periods[k].drive_amplitude_N, expected[k])
              << every << ' ' << drive_delay << ' ' << sensor_delay << ' ' << k;
        }
        EXPECT_EQ(logged.result.control->commands, periods / static_cast<unsigned>(every));
      }
    }
  }
}

/// Over the last 50 periods before one.
double mean_ratio(const LoggedRun& logged, std::size_t end) {
  double sum = 0.0;
  for (std::size_t k = end - 50; k < end; ++k) {
    sum += logged.periods[k].friction_ratio;
  }
  return sum / 50.0;
}

TEST(EveryPeriodsTest, ReachesItsTargetsInEachArithmetic) {
  for (const Arithmetic arithmetic :
       {Arithmetic::float64, Arithmetic::float32, Arithmetic::q31, Arithmetic::q15}) {
    for (int every = 1; every <= 16; ++every) {
      // The mode of Table 1 is near a multiple of a 14th of the carrier, so that its notch is long.
      const std::size_t of_periods = every == 14 ? 5 * periods : periods;
      const LoggedRun logged = run_logged(loop_of(arithmetic, every, of_periods));
      EXPECT_NEAR(mean_ratio(logged, of_periods / 2), 0.4, 0.01) << every;
      EXPECT_NEAR(mean_ratio(logged, of_periods), 0.6, 0.01) << every;
      EXPECT_TRUE(logged.result.control->faults.empty()) << every;
    }
  }
}

TEST(EveryPeriodsTest, TheSlewLimitHoldsFromOneCarrierPeriodToTheNext) {
  for (const int every : {2, 5, 16}) {
    scene::Scene scene = loop_of(Arithmetic::float32, every);
    constexpr double slew_N_per_s = 5e6;
    scene.drive->max_force_slew_N_per_s = slew_N_per_s;
    const LoggedRun logged = run_logged(scene);
    for (std::size_t k = 1; k < periods; ++k) {
      EXPECT_LE(
          std::abs(logged.periods[k].drive_amplitude_N - logged.periods[k - 1].drive_amplitude_N),
          slew_N_per_s * period_s * (1.0 + 1e-6));
    }
  }
}

TEST(EveryPeriodsTest, SavedInTheMiddleOfAStepItGoesOnFromThere) {
  const configure::Experiment experiment = configure::make_experiment(loop_of(Arithmetic::q31, 5));
  SteppedScene straight(experiment, Kind::loop);
  SteppedScene broken(experiment, Kind::loop);
  for (int k = 0; k < 63; ++k) {
    straight.advance({});
    broken.advance({});
  }
  StateCopy saved;
  broken.copy_state(saved);
  for (int k = 0; k < 4; ++k) {
    broken.advance({});
  }
  const Snapshot snapshot = saved.take();
  StateCopy reader(snapshot);
  broken.copy_state(reader);
  for (int k = 0; k < 100; ++k) {
    straight.advance({});
    broken.advance({});
    ASSERT_EQ(broken.controller().trace_hash, straight.controller().trace_hash) << k;
  }
}

}  // namespace
}  // namespace sonoglide::loop::every_periods_test
