#include "host_sim/runs/rollouts.hpp"

#include <fmt/format.h>

#include <deque>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/stepped.hpp"
#include "host_sim/runs/closed_loops.hpp"
#include "host_sim/runs/run_many.hpp"

namespace sonoglide::runs {
namespace {

class RatioSink final : public loop::PeriodSink {
 public:
  explicit RatioSink(double* ratios) : next_(ratios) {}
  void take(const loop::Period& period) override {
    if (period.whole) {
      *next_++ = period.friction_ratio;
    }
  }

 private:
  double* next_;
};

void require_targets(const Rollout& rollout, std::size_t place) {
  const std::size_t periods = whole_periods(rollout.experiment.plant);
  if (rollout.targets == nullptr) {
    return;
  }
  loop::require_usable(rollout.experiment.plant, loop::Kind::loop);
  loop::require_constant_carrier(rollout.experiment.plant);
  const double most = rollout.experiment.plant.highest_target();
  for (std::size_t i = 0; i < periods; ++i) {
    if (!(rollout.targets[i] >= 0.0 && rollout.targets[i] <= most)) {
      throw std::invalid_argument(
          fmt::format("the target of rollout {} in carrier period {} is {}; allowed: 0 to {}",
                      place, i, rollout.targets[i], most));
    }
  }
}

void step_through(const Rollout& rollout) {
  loop::SteppedScene engine(rollout.experiment, loop::Kind::loop);
  loop::Inputs inputs;
  const std::size_t periods = whole_periods(rollout.experiment.plant);
  for (std::size_t i = 0; i < periods; ++i) {
    inputs.target = rollout.targets[i];
    engine.advance(inputs);
    rollout.friction_ratios[i] = engine.plant().friction_ratio;
  }
}

void run_one(const Rollout& rollout, std::size_t place) try {
  if (rollout.targets != nullptr) {
    step_through(rollout);
    return;
  }
  RatioSink sink(rollout.friction_ratios);
  loop::Watch watch;
  watch.periods.push_back(&sink);
  watch.energies = false;
  loop::run(rollout.experiment, watch);
} catch (const loop::ComputationError& error) {
  throw loop::ComputationError(fmt::format("rollout {}: {}", place, error.what()));
}

/// @return those that the lanes give up
Places run_in_lanes(const std::vector<Rollout>& rollouts, const Places& places) {
  std::deque<RatioSink> sinks;
  std::vector<ClosedLoop> loops;
  for (const std::size_t place : places) {
    const Rollout& rollout = rollouts[place];
    loops.push_back({rollout.experiment.plant, *rollout.experiment.design,
                     sinks.emplace_back(rollout.friction_ratios)});
  }
  return given_up(places, run_closed_loops(loops));
}

}  // namespace

std::size_t whole_periods(const scene::Scene& scene) {
  loop::require_usable(scene, scene.controller ? loop::Kind::loop : loop::Kind::plant);
  loop::require_constant_carrier(scene);
  const loop::CarrierGrid grid(scene);
  return grid.count() - (grid.is_whole(grid.count() - 1) ? 0 : 1);
}

void run_rollouts(const std::vector<Rollout>& rollouts) {
  for (std::size_t i = 0; i < rollouts.size(); ++i) {
    require_targets(rollouts[i], i);
  }
  Places all(rollouts.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const Calls calls = divide(all, [&](std::size_t place) {
    const Rollout& rollout = rollouts[place];
    return rollout.targets == nullptr && runs_in_lanes(rollout.experiment.plant) ? std::optional(0)
                                                                                 : std::nullopt;
  });
  run_many(
      calls, [&](const Places& places) { return run_in_lanes(rollouts, places); },
      [&](std::size_t place) { run_one(rollouts[place], place); });
}

}  // namespace sonoglide::runs
