/// Runs that are short enough to keep everything of them.
#pragma once

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

LoggedRun run_logged(const scene::Scene& scene);

}  // namespace sonoglide::loop
