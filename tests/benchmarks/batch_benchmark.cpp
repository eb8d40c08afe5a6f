/// Many plants at once, and the friction-ratio map: points per second, and the errors that go with
/// them. The label names the instruction set.

#include <benchmark/benchmark.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "firmware/friction/dahl_friction_ratio.hpp"
#include "host_sim/batch/dahl_friction_ratios.hpp"
#include "host_sim/batch/run_dahl_plants.hpp"
#include "tests/host_sim/batch/runs/plants.hpp"
#include "tests/host_sim/batch/runs/scalar_run.hpp"

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

/// a in [1e-4, 1e7], r in [0, 1.5]; the error is absolute, against the scalar map.
void friction_ratio_map(benchmark::State& state) {
  constexpr std::size_t count = 4096;
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> velocity_ratios(count);
  std::vector<double> dahl_numbers(count);
  for (std::size_t i = 0; i < count; ++i) {
    velocity_ratios[i] = 1.5 * unit(generator);
    dahl_numbers[i] = 1e-4 * std::pow(10.0, 11.0 * unit(generator));
  }
  std::vector<double> ratios(count);
  for (auto _ : state) {
    dahl_friction_ratios(velocity_ratios.data(), dahl_numbers.data(), count, ratios.data());
    benchmark::DoNotOptimize(ratios.data());
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double expected = friction::dahl_friction_ratio(velocity_ratios[i], dahl_numbers[i]);
    worst = std::max(worst, std::abs(ratios[i] - expected));
  }
  report(state, count, worst);
}
BENCHMARK(friction_ratio_map);

}  // namespace
}  // namespace sonoglide::batch
