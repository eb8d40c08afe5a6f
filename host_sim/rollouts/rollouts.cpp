#include "host_sim/rollouts/rollouts.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <deque>
#include <stdexcept>

#include "host_sim/lanes/closed_loops.hpp"
#include "host_sim/loop/carrier_grid.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/stepped/engine.hpp"

namespace sonoglide::rollouts {
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
  const std::size_t periods = whole_periods(rollout.scene);
  if (rollout.targets == nullptr) {
    return;
  }
  stepped::require_usable(rollout.scene, stepped::Kind::loop);
  stepped::require_constant_carrier(rollout.scene);
  for (std::size_t i = 0; i < periods; ++i) {
    if (!(rollout.targets[i] >= 0.0 && rollout.targets[i] <= 1.0)) {
      throw std::invalid_argument(
          fmt::format("the target of rollout {} in carrier period {} is {}; allowed: 0 to 1", place,
                      i, rollout.targets[i]));
    }
  }
}

void step_through(const Rollout& rollout) {
  stepped::Engine engine(rollout.scene, stepped::Kind::loop);
  stepped::Inputs inputs;
  const std::size_t periods = whole_periods(rollout.scene);
  for (std::size_t i = 0; i < periods; ++i) {
    inputs.target_friction_ratio = rollout.targets[i];
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
  loop::run(rollout.scene, watch);
} catch (const loop::ComputationError& error) {
  throw loop::ComputationError(fmt::format("rollout {}: {}", place, error.what()));
}

/// Rollouts that are computed in one go.
struct Call {
  std::vector<std::size_t> places;
  bool in_lanes;
};

/// Those that suit lanes together, some hundreds at most, the others alone.
std::vector<Call> calls(const std::vector<Rollout>& rollouts, std::size_t threads) {
  constexpr std::size_t fewest_in_lanes = 16;
  constexpr std::size_t lanes_many_times_over = 256;
  std::vector<Call> calls;
  std::vector<std::size_t> together;
  for (std::size_t i = 0; i < rollouts.size(); ++i) {
    if (rollouts[i].targets == nullptr && lanes::runs_in_lanes(rollouts[i].scene)) {
      together.push_back(i);
    } else {
      calls.push_back({{i}, false});
    }
  }
  const std::size_t share =
      std::clamp(together.size() / threads, fewest_in_lanes, lanes_many_times_over);
  for (std::size_t begin = 0; begin < together.size(); begin += share) {
    const std::size_t end = std::min(begin + share, together.size());
    calls.push_back({{together.begin() + static_cast<std::ptrdiff_t>(begin),
                      together.begin() + static_cast<std::ptrdiff_t>(end)},
                     true});
  }
  return calls;
}

/// What the lanes give up is run as `run` does.
void run_in_lanes(const std::vector<Rollout>& rollouts, const std::vector<std::size_t>& places) {
  std::deque<configure::ControlDesign> designs;
  std::deque<RatioSink> sinks;
  std::vector<lanes::ClosedLoop> loops;
  for (const std::size_t place : places) {
    const Rollout& rollout = rollouts[place];
    loops.push_back({rollout.scene, designs.emplace_back(configure::design_control(rollout.scene)),
                     sinks.emplace_back(rollout.friction_ratios)});
  }
  const std::vector<lanes::LoopRun> runs = lanes::run_closed_loops(loops);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].status != batch::RunStatus::solved) {
      run_one(rollouts[places[i]], places[i]);
    }
  }
}

}  // namespace

std::size_t whole_periods(const scene::Scene& scene) {
  stepped::require_usable(scene, stepped::Kind::plant);
  stepped::require_constant_carrier(scene);
  const loop::CarrierGrid grid(scene);
  return grid.count() - (grid.is_whole(grid.count() - 1) ? 0 : 1);
}

void run_rollouts(const std::vector<Rollout>& rollouts, unsigned threads) {
  for (std::size_t i = 0; i < rollouts.size(); ++i) {
    require_targets(rollouts[i], i);
  }
  const std::size_t used =
      threads > 0 ? threads : static_cast<std::size_t>(tbb::info::default_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, used);
  const std::vector<Call> all = calls(rollouts, used);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, all.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          if (all[i].in_lanes) {
            run_in_lanes(rollouts, all[i].places);
          } else {
            run_one(rollouts[all[i].places.front()], all[i].places.front());
          }
        }
      },
      tbb::simple_partitioner());
}

}  // namespace sonoglide::rollouts
