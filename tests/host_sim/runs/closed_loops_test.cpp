#include "host_sim/runs/closed_loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

#include "host_sim/loop/run.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/runs/plants/plants_near.hpp"

namespace sonoglide::runs::closed_loops_test {
namespace {

using tests::table_1_closed_loop;

scene::Scene nominal_scene(scene::Arithmetic arithmetic) {
  scene::Scene scene = table_1_closed_loop(arithmetic);
  scene.solver.tolerance = closed_loop_tolerance;
  return scene;
}

struct Measured {
  batch::RunStatus status;
  std::uint64_t trace_hash;
  std::vector<report::StepMetrics> steps;
};

std::vector<Measured> in_lanes(const std::vector<scene::Scene>& plants,
                               const configure::ControlDesign& design) {
  std::vector<report::StepMeter> meters;
  meters.reserve(plants.size());
  std::vector<ClosedLoop> loops;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    EXPECT_TRUE(runs_in_lanes(plants[i])) << i;
    loops.push_back({plants[i], design, meters.emplace_back(plants[i], design)});
  }
  std::vector<Measured> measured;
  for (const LoopRun& run : run_closed_loops(loops)) {
    measured.push_back({run.status, run.control.trace_hash, meters[measured.size()].steps()});
  }
  return measured;
}

/// By the scalar solver at its default tolerance, 1e-10.
std::vector<report::StepMetrics> one_by_one(scene::Scene plant,
                                            const configure::ControlDesign& design) {
  plant.solver.tolerance = 1e-10;
  report::StepMeter meter(plant, design);
  loop::Watch watch;
  watch.periods.push_back(&meter);
  loop::run(plant, design, watch);
  return meter.steps();
}

/// Largest differences over all steps.
struct Differences {
  double settling_periods = 0.0;
  double steady_error = 0.0;
  double ripple = 0.0;
  double overshoot = 0.0;
  std::size_t settled = 0;
};

void add(const report::StepMetrics& step, const report::StepMetrics& expected,
         Differences& differences) {
  const auto enlarge = [](double& largest, double a, double b) {
    largest = std::max(largest, std::abs(a - b));
  };
  ASSERT_EQ(step.settling_time_s.has_value(), expected.settling_time_s.has_value());
  EXPECT_EQ(step.limit, expected.limit);
  if (step.settling_time_s) {
    enlarge(differences.settling_periods, *step.settling_time_s * tests::carrier_Hz,
            *expected.settling_time_s * tests::carrier_Hz);
    ++differences.settled;
  }
  enlarge(differences.steady_error, step.steady_error, expected.steady_error);
  enlarge(differences.ripple, step.ripple, expected.ripple);
  enlarge(differences.overshoot, step.overshoot, expected.overshoot);
}

Differences compare(const std::vector<scene::Scene>& plants,
                    const configure::ControlDesign& design) {
  Differences differences;
  const std::vector<Measured> measured = in_lanes(plants, design);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(measured[i].status, batch::RunStatus::solved);
    const std::vector<report::StepMetrics> expected = one_by_one(plants[i], design);
    for (std::size_t step = 0; step < expected.size(); ++step) {
      add(measured[i].steps[step], expected[step], differences);
    }
  }
  return differences;
}

class AsOneByOne : public testing::TestWithParam<scene::Arithmetic> {};

TEST_P(AsOneByOne, WithinThePromisedError) {
  const scene::Scene nominal = nominal_scene(GetParam());
  const Differences differences =
      compare(plants_near(nominal, 40, 0.002), configure::design_control(nominal));
  EXPECT_GT(differences.settled, 60U);
  EXPECT_LT(differences.settling_periods, 1e-6);
  EXPECT_LT(differences.steady_error, 1e-7);
  EXPECT_LT(differences.ripple, 1e-6);
  EXPECT_LT(differences.overshoot, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Arithmetics, AsOneByOne,
                         testing::Values(scene::Arithmetic::float64, scene::Arithmetic::float32,
                                         scene::Arithmetic::q31),
                         [](const auto& chosen) {
                           return chosen.param == scene::Arithmetic::float64   ? "float64"
                                  : chosen.param == scene::Arithmetic::float32 ? "float32"
                                                                               : "q31";
                         });

TEST(ClosedLoops, FarFromTheDesignTheyAreMeasuredAlike) {
  const scene::Scene nominal = nominal_scene(scene::Arithmetic::float32);
  const Differences differences =
      compare(plants_near(nominal, 40, 0.1), configure::design_control(nominal));
  EXPECT_LT(differences.steady_error, 1e-7);
  EXPECT_LT(differences.ripple, 1e-6);
}

TEST(ClosedLoops, HaveTheSensorOfTheScene) {
  scene::Scene nominal = nominal_scene(scene::Arithmetic::float32);
  nominal.sensor.force_bandwidth_Hz = 20e3;
  nominal.sensor.delay_periods = 2;
  nominal.sensor.force_gain = 1.05;
  nominal.sensor.force_offset_N = 1e-4;
  nominal.controller->calibration_s = 2e-4;
  nominal.drive->delay_periods = 3;
  const Differences differences =
      compare(plants_near(nominal, 20, 0.002), configure::design_control(nominal));
  EXPECT_LT(differences.settling_periods, 1e-6);
  EXPECT_LT(differences.steady_error, 1e-7);
  EXPECT_LT(differences.ripple, 1e-6);
}

/// The controller knows nothing of it.
TEST(ClosedLoops, MayPassFromAmplitudeToAmplitudeAlongALine) {
  scene::Scene nominal = nominal_scene(scene::Arithmetic::float32);
  nominal.drive->interpolation = scene::Interpolation::linear;
  const Differences differences =
      compare(plants_near(nominal, 10, 0.002), configure::design_control(nominal));
  EXPECT_LT(differences.steady_error, 1e-7);
  EXPECT_LT(differences.ripple, 1e-6);
}

TEST(ClosedLoops, MayHaveATransducer) {
  scene::Scene nominal = nominal_scene(scene::Arithmetic::float32);
  nominal.transducer = {16.0, 2e-6, 0.0};
  const Differences differences =
      compare(plants_near(nominal, 10, 0.002), configure::design_control(nominal));
  EXPECT_LT(differences.steady_error, 1e-7);
  EXPECT_LT(differences.ripple, 1e-6);
}

TEST(ClosedLoops, HaveItsNoiseAndItsConverter) {
  scene::Scene nominal = nominal_scene(scene::Arithmetic::float32);
  nominal.sensor.adc_bits = 12;
  nominal.sensor.force_noise_N = 1e-4;
  nominal.sensor.seed = 3;
  const Differences differences =
      compare(plants_near(nominal, 20, 0.002), configure::design_control(nominal));
  // A step of the converter is 9.8e-4 of Fc: some fall the other way.
  EXPECT_LT(differences.steady_error, 2.5e-4);
}

std::vector<scene::Scene> reversed(std::vector<scene::Scene> plants) {
  std::reverse(plants.begin(), plants.end());
  return plants;
}

void expect_same(const std::vector<Measured>& some, const std::vector<Measured>& others) {
  ASSERT_EQ(some.size(), others.size());
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(some[i].trace_hash, others[i].trace_hash) << i;
    ASSERT_EQ(some[i].steps.size(), others[i].steps.size());
    for (std::size_t step = 0; step < some[i].steps.size(); ++step) {
      EXPECT_EQ(some[i].steps[step].settling_time_s, others[i].steps[step].settling_time_s);
      EXPECT_EQ(some[i].steps[step].steady_error, others[i].steps[step].steady_error);
      EXPECT_EQ(some[i].steps[step].ripple, others[i].steps[step].ripple);
    }
  }
}

class SameBits : public testing::Test {
 protected:
  const scene::Scene nominal = nominal_scene(scene::Arithmetic::float32);
  const configure::ControlDesign design = configure::design_control(nominal);
  const std::vector<scene::Scene> plants = plants_near(nominal, 37, 0.02);
};

TEST_F(SameBits, InAnyOrder) {
  std::vector<Measured> backwards = in_lanes(reversed(plants), design);
  std::reverse(backwards.begin(), backwards.end());
  expect_same(backwards, in_lanes(plants, design));
}

TEST_F(SameBits, OnAnyNumberOfThreads) {
  const std::vector<Measured> together = in_lanes(plants, design);
  for (const std::size_t count : {2U, 3U, 5U}) {
    std::vector<std::vector<Measured>> parts(count);
    std::vector<std::thread> threads;
    for (std::size_t part = 0; part < count; ++part) {
      threads.emplace_back([&, part] {
        std::vector<scene::Scene> share;
        for (std::size_t i = part; i < plants.size(); i += count) {
          share.push_back(plants[i]);
        }
        parts[part] = in_lanes(share, design);
      });
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
    std::vector<Measured> joined;
    for (std::size_t i = 0; i < plants.size(); ++i) {
      joined.push_back(parts[i % count][i / count]);
    }
    expect_same(joined, together);
  }
}

TEST_F(SameBits, BesideALoopThatIsGivenUp) {
  std::vector<scene::Scene> mixed = plants;
  scene::Scene stuck = nominal;
  stuck.friction.coefficient = 1e6;
  stuck.friction.contact_stiffness_N_per_m = 1e16;
  mixed.insert(mixed.begin() + 3, stuck);
  std::vector<Measured> measured = in_lanes(mixed, design);
  EXPECT_EQ(measured[3].status, batch::RunStatus::too_many_steps);
  measured.erase(measured.begin() + 3);
  expect_same(measured, in_lanes(plants, design));
}

TEST(RunsInLanes, OnlyWhatTheLanesAreMadeFor) {
  const scene::Scene nominal = nominal_scene(scene::Arithmetic::float32);
  EXPECT_TRUE(runs_in_lanes(nominal));
  const auto refused = [&nominal](auto change) {
    scene::Scene scene = nominal;
    change(scene);
    return !runs_in_lanes(scene);
  };
  using scene::Scene;
  EXPECT_TRUE(refused([](Scene& s) { s.controller.reset(); }));
  EXPECT_TRUE(refused([](Scene& s) { s.solver.tolerance = 9e-7; }));
  EXPECT_TRUE(refused([](Scene& s) { s.solver.order = 12; }));
  EXPECT_TRUE(
      refused([](Scene& s) { s.solver.method = scene::method_of<scene::solvers::Strang>; }));
  EXPECT_TRUE(refused([](Scene& s) { s.friction.law = scene::laws::Coulomb{}; }));
  EXPECT_TRUE(refused([](Scene& s) { s.friction.coefficient = 0.0; }));
  EXPECT_TRUE(refused([](Scene& s) { s.drive->waveform = scene::Waveform::square; }));
  EXPECT_TRUE(refused([](Scene& s) { s.drive->bias_limit_N = 1.0; }));
  EXPECT_TRUE(refused([](Scene& s) {
    s.drive->interpolation = scene::Interpolation::linear;
    s.drive->codes_per_period = 8;
  }));
  EXPECT_TRUE(refused([](Scene& s) { s.sliding.profile.push_back({1e-3, 0.03}); }));
  EXPECT_TRUE(refused([](Scene& s) { s.plant.stiffness_profile = {{0.0, 133e6}, {1e-3, 130e6}}; }));
  EXPECT_TRUE(refused([](Scene& s) { s.plant.stiffness_N_per_m *= 30.0; }));
  EXPECT_TRUE(refused([](Scene& s) { s.run.duration_s = 0.5 * tests::period_s; }));
  EXPECT_TRUE(refused([](Scene& s) {
    s.controller->vibration = scene::VibrationControl::damped;
    s.sensor.vibration = scene::VibrationSensor::velocity;
  }));
}

}  // namespace
}  // namespace sonoglide::runs::closed_loops_test
