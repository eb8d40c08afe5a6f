/// Runs that are short enough to keep everything of them.
#pragma once

#include <utility>
#include <vector>

#include "host_sim/loop/run.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

struct PeriodLog final : PeriodSink {
  std::vector<Period> periods;

  void take(const Period& period) override { periods.push_back(period); }
};

struct LoggedRun {
  RunResult result;
  std::vector<Period> periods;
  Recording trace;  ///< as the scene asks
};

inline LoggedRun run_logged(const scene::Scene& scene) {
  LoggedRun logged;
  PeriodLog log;
  Watch watch;
  watch.periods = {&log};
  if (!scene.run.record.empty()) {
    watch.samples = {{{0.0, scene.run.duration_s, scene.run.record_interval_s}, &logged.trace}};
  }
  logged.result = run(scene, watch);
  logged.periods = std::move(log.periods);
  return logged;
}

}  // namespace sonoglide::loop
