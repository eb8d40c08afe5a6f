/// Many plants at once: points per second, and the errors that go with them. The label names the
/// instruction set.

#include <benchmark/benchmark.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "tests/host_sim/runs/batch/runs/plants.hpp"
#include "tests/host_sim/runs/batch/runs/scalar_run.hpp"

namespace sonoglide::batch {
namespace {

const char* instruction_set() {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  return hwy::TargetName(*std::min_element(targets.begin(), targets.end()));
}

void report(benchmark::State& state, std::size_t count, double worst_error) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
  state.counters["worst_error"] = worst_error;
  state.SetLabel(instruction_set());
}

/// Table 1, 32 x 32 over velocity ratio and contact stiffness, 100 periods from rest. The error is
/// relative, of the whole-run friction ratio, against the scalar solver.
void sweep(benchmark::State& state, Accuracy accuracy) {
  const std::vector<DahlPlant> plants = table_1_sweep(32);
  const RunLength length = {100, 50};
  std::vector<DahlRun> runs;
  for (auto _ : state) {
    runs = run_dahl_plants(plants, length, accuracy);
    benchmark::DoNotOptimize(runs.data());
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const double expected = scalar_run(plants[i], length).whole.friction_ratio;
    worst = std::max(worst, std::abs(runs[i].whole.friction_ratio / expected - 1.0));
  }
  report(state, plants.size(), worst);
}
BENCHMARK_CAPTURE(sweep, map, Accuracy::map)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sweep, fine, Accuracy::fine)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sonoglide::batch
