#include "host_sim/studies/sweep/scalar_point.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "host_sim/loop/run.hpp"
#include "host_sim/report/step_metrics.hpp"

namespace sonoglide::sweep {
namespace {

Row run(const scene::Scene& scene) {
  std::optional<report::StepMeter> meter;
  loop::Watch watch;
  if (scene.controller) {
    watch.periods.push_back(&meter.emplace(scene));
  }
  const loop::RunResult result = loop::run(scene, watch);
  const loop::PowerRatios window = loop::power_ratios(scene, result.window);
  Row row;
  row.friction_ratio_whole_run = loop::power_ratios(scene, result.whole).friction_ratio;
  row.friction_ratio_window = window.friction_ratio;
  row.dissipation_ratio_window = window.dissipation_ratio;
  if (meter) {
    const report::StepMetrics last = meter->steps().back();
    row.settling_time_s = last.settling_time_s.value_or(Row::undefined);
    row.steady_error = last.steady_error;
    row.ripple = last.ripple;
    row.limit = last.limit;
    const std::vector<loop::FaultEvent>& faults = result.control->faults;
    row.fault = faults.empty() ? control::Fault::none : faults.front().fault;
  }
  return row;
}

/// Control characters would break a line of the table.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

}  // namespace

Row solve_scalar_point(const scene::Scene& scene) {
  try {
    return run(scene);
  } catch (const loop::ComputationError& error) {
    Row failed;
    failed.status = one_line(error.what());
    return failed;
  }
}

}  // namespace sonoglide::sweep
