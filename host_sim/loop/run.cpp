#include "host_sim/loop/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "host_sim/loop/control_run.hpp"
#include "host_sim/loop/plant_run.hpp"
#include "host_sim/loop/time_rounding.hpp"
#include "host_sim/scene/plant_scales.hpp"

namespace sonoglide::loop {
namespace {

constexpr std::uint64_t progress_calls = 500;

Period describe(const EnergyBalance& energy, const SlidingProfile& sliding, double begin_s,
                double end_s, double amplitude_N, double friction_N) {
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  const double ratio = friction_N > 0.0
                           ? energy.resistance_impulse_N_s / (friction_N * energy.duration_s)
                           : undefined;
  return {begin_s,
          end_s,
          ratio,
          sliding.velocity_m_per_s(begin_s),
          sliding.velocity_m_per_s(end_s),
          amplitude_N,
          undefined,
          control::State::off,
          control::Limit::none};
}

/// The run cut into carrier periods; the last one may be cut short.
struct CarrierGrid {
  double period_s;
  double end_s;
  std::uint64_t count;

  CarrierGrid(double period, double end)
      : period_s(period),
        end_s(end),
        count(static_cast<std::uint64_t>(std::max(1.0, std::ceil(end / period - time_rounding)))) {}

  double begin(std::uint64_t index) const { return static_cast<double>(index) * period_s; }
  double end(std::uint64_t index) const { return index + 1 < count ? begin(index + 1) : end_s; }
  bool whole(std::uint64_t index) const {
    return index + 1 < count || end_s - begin(index) >= (1.0 - time_rounding) * period_s;
  }
};

std::unique_ptr<ControlRun> make_control(const scene::Scene& scene, RunResult& result) {
  if (!scene.controller) {
    return nullptr;
  }
  result.control.emplace();
  result.control->design = scene::design_control(scene);
  return std::make_unique<ControlRun>(scene, *result.control);
}

void simulate(const scene::Scene& scene, RunResult& result, const Progress& progress) {
  PlantRun plant(scene, result);
  const std::unique_ptr<ControlRun> control = make_control(scene, result);
  const double friction_N = scene::friction_limit_N(scene.friction);
  const double open_loop_amplitude_N = scene.drive ? scene.drive->force_amplitude_N : 0.0;
  const CarrierGrid grid(plant.period_s(), scene.run.duration_s);
  const std::uint64_t report_every = grid.count / progress_calls + 1;
  for (std::uint64_t k = 0; k < grid.count; ++k) {
    const double amplitude_N = control ? control->amplitude_N() : open_loop_amplitude_N;
    const EnergyBalance energy = plant.advance(grid.begin(k), grid.end(k), amplitude_N);
    Period period =
        describe(energy, plant.sliding(), grid.begin(k), grid.end(k), amplitude_N, friction_N);
    if (control) {
      control->label(period);
      if (grid.whole(k)) {
        control->step(period.end_s, energy.friction_impulse_N_s / energy.duration_s,
                      period.end_velocity_m_per_s);
      }
    }
    result.periods.push_back(period);
    if (progress && k % report_every == 0) {
      progress(static_cast<double>(k) / static_cast<double>(grid.count));
    }
  }
  plant.finish();
  if (control) {
    control->finish();
  }
}

}  // namespace

RunResult run(const scene::Scene& scene, const Progress& progress) {
  RunResult result;
  const auto begin = std::chrono::steady_clock::now();
  simulate(scene, result, progress);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  result.wall_s = wall.count();
  return result;
}

}  // namespace sonoglide::loop
