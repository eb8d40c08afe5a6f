/// A closed loop's run with the figures of its target steps.
#pragma once

#include <utility>
#include <vector>

#include "host_sim/report/step_metrics.hpp"
#include "host_sim/scene/scene.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::acceptance {

struct MeasuredRun {
  loop::LoggedRun run;
  std::vector<report::StepMetrics> steps;
};

inline MeasuredRun run_measured(const scene::Scene& scene) {
  loop::LoggedRun run = loop::run_logged(scene);
  report::StepMeter meter(scene, run.result.control->design);
  for (const loop::Period& period : run.periods) {
    meter.take(period);
  }
  return {std::move(run), meter.steps()};
}

}  // namespace sonoglide::acceptance
