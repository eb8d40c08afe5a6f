/// Closed loops of 6 ms at Table 1, each on a plant of its own: loops per second of one core.

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/runs/closed_loops.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/runs/plants/plants_near.hpp"

namespace sonoglide::runs {
namespace {

constexpr std::size_t count = 128;

/// As target_step.toml, without its recording.
scene::Scene nominal_scene(double tolerance) {
  scene::Scene scene = tests::table_1_closed_loop(scene::Arithmetic::float32);
  scene.controller->target_friction_ratio = {{0.0, 0.4}, {2e-3, 0.6}, {4e-3, 0.5}};
  scene.run.duration_s = 6e-3;
  scene.solver.tolerance = tolerance;
  return scene;
}

template <class RunAll>
void run_loops(benchmark::State& state, const scene::Scene& nominal, const RunAll& run_all) {
  const configure::ControlDesign design = configure::design_control(nominal);
  const std::vector<scene::Scene> plants = plants_near(nominal, count, 0.02);
  for (auto _ : state) {
    std::vector<report::StepMeter> meters;
    for (const scene::Scene& plant : plants) {
      meters.emplace_back(plant, design);
    }
    run_all(plants, design, meters);
    for (const report::StepMeter& meter : meters) {
      benchmark::DoNotOptimize(meter.steps());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(plants.size()));
}

void one_by_one(benchmark::State& state, scene::SolverMethod method, double tolerance) {
  scene::Scene nominal = nominal_scene(tolerance);
  nominal.solver.method = method;
  run_loops(state, nominal, [](const auto& plants, const auto& design, auto& meters) {
    for (std::size_t i = 0; i < plants.size(); ++i) {
      loop::Watch watch;
      watch.periods.push_back(&meters[i]);
      watch.energies = false;
      benchmark::DoNotOptimize(loop::run(plants[i], design, watch));
    }
  });
}

constexpr auto event_taylor = scene::method_of<scene::solvers::EventTaylor>;
constexpr auto event_gauss = scene::method_of<scene::solvers::EventGauss>;
BENCHMARK_CAPTURE(one_by_one, event_taylor, event_taylor, 1e-6)
    ->Name("loops/one_by_one/event_taylor/1e-6")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(one_by_one, event_gauss, event_gauss, 1e-6)
    ->Name("loops/one_by_one/event_gauss/1e-6")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(one_by_one, event_gauss_fine, event_gauss, 1e-10)
    ->Name("loops/one_by_one/event_gauss/1e-10")
    ->Unit(benchmark::kMillisecond);

void in_lanes(benchmark::State& state) {
  run_loops(state, nominal_scene(closed_loop_tolerance),
            [](const auto& plants, const auto& design, auto& meters) {
              std::vector<ClosedLoop> loops;
              for (std::size_t i = 0; i < plants.size(); ++i) {
                loops.push_back({plants[i], design, meters[i]});
              }
              benchmark::DoNotOptimize(run_closed_loops(loops));
            });
  state.SetLabel(batch::instruction_set());
}
BENCHMARK(in_lanes)->Name("loops/in_lanes/1e-6")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sonoglide::runs
