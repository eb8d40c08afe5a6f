#include "tests/host_sim/loop/logs/logged_run.hpp"

#include <utility>

namespace sonoglide::loop {

LoggedRun run_logged(const scene::Scene& scene) {
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
