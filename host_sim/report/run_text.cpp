#include <cmath>

#include <fmt/format.h>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/report/words.hpp"

namespace sonoglide::report {
namespace {

std::string settling(const std::optional<double>& time_s) {
  return time_s ? fmt::format("{:.1f} us", *time_s * 1e6) : std::string("never");
}

std::string pause_line(const report::PauseMetrics& metrics) {
  return fmt::format(
      "friction learnt anew in {} pauses, {:.3g} % of the time; they raise the mean ratio by "
      "{:.2g}\n",
      metrics.pauses, 100.0 * metrics.time_fraction, metrics.ratio_cost);
}

std::string step_lines(const loop::RunResult& result, const RunFindings& findings) {
  std::string text = fmt::format("{:>11} {:>7} {:>11} {:>10} {:>8} {:>10}  {}\n", "from", "target",
                                 "settles in", "error", "ripple", "drive", "limit");
  for (const report::StepMetrics& step : findings.steps()) {
    text += fmt::format("{:>8.3f} ms {:>7.3f} {:>11} {:>10} {:>8} {:>8} N  {}\n", step.time_s * 1e3,
                        step.target, settling(step.settling_time_s),
                        figure("{:+.5f}", step.steady_error),
                        figure("{:.5f}", step.ripple),
                        figure("{:.1f}", step.drive_amplitude_N), limit_text(step));
  }
  if (result.control->design.relearns) {
    text += pause_line(findings.pauses());
  }
  for (const loop::FaultEvent& event : result.control->faults) {
    text += fmt::format("FAULT at {:.3f} ms: {}; the drive is off from there on\n",
                        event.time_s * 1e3, fault_name(event.fault));
  }
  return text;
}

std::string ratio_line(const scene::Scene& scene, const loop::RunResult& result) {
  if (configure::largest_friction_limit_N(scene.friction) == 0.0) {
    return "no friction, so no friction ratio\n";
  }
  return fmt::format("friction ratio {:.6f} over the whole run, {:.6f} from {:.6g} s on\n",
                     loop::power_ratios(scene, result.whole).friction_ratio,
                     loop::power_ratios(scene, result.window).friction_ratio,
                     scene.run.window_start_s);
}

}  // namespace

std::string run_text(const scene::Scene& scene, const loop::RunResult& result,
                     const RunFindings& findings, const std::filesystem::path& out) {
  const std::string lines =
      scene.controller ? step_lines(result, findings) : ratio_line(scene, result);
  return fmt::format("{}{}{:.6g} ms simulated in {:.3g} ms, {:.3g} times real time\nreport: {}\n",
                     lines, result.image ? image_lines(*result.image) : "",
                     result.final_time_s * 1e3, result.wall_s * 1e3,
                     result.final_time_s / result.wall_s,
                     process::printable((out / "report.html").string()));
}

}  // namespace sonoglide::report
