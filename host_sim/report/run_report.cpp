#include "host_sim/report/run_report.hpp"

#include <fmt/format.h>

#include "firmware/control/interface/names.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/report/run_notes.hpp"
#include "host_sim/report/run_parts.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/scene/solver_facts.hpp"

namespace sonoglide::report {
namespace {

constexpr const char* summary_file = "summary.json";
constexpr const char* page_file = "report.html";
constexpr const char* trace_file = "trace.csv";
constexpr const char* periods_file = "periods.csv";

}  // namespace

RunReport::RunReport(const std::filesystem::path& out, const configure::Experiment& experiment)
    : experiment_(experiment),
      folder_(out, {summary_file, page_file, trace_file, periods_file}),
      findings_(experiment) {
  const scene::Scene& scene = experiment.plant;
  if (!scene.run.record.empty()) {
    periods_.emplace(CsvFile(folder_.open(periods_file)), amplitude_unit(scene),
                     target_unit(scene).is_force(), scene.drive && scene.drive->bias_limit_N > 0.0);
    trace_.emplace(CsvFile(folder_.open(trace_file)), scene.run.record);
  } else {
    folder_.withdraw(periods_file);
    folder_.withdraw(trace_file);
  }
}

void RunReport::join(loop::Watch& watch) {
  findings_.join(watch);
  if (trace_) {
    watch.periods.push_back(&*periods_);
    const scene::Run& run = experiment_.plant.run;
    watch.samples.push_back({{0.0, run.duration_s, run.record_interval_s}, &*trace_});
  }
}

void RunReport::finish(const loop::RunResult& result) {
  folder_.write(summary_file, summary_text(experiment_, result, findings_));
  folder_.write(page_file, output::to_html(run_page(experiment_, result, findings_)));
  folder_.commit();
}

namespace {

std::string warning_lines(const std::vector<std::string>& warnings) {
  std::string lines;
  for (const std::string& each : warnings) {
    lines += fmt::format("WARNING: {}\n", each);
  }
  return lines;
}

std::string settling(const std::optional<double>& time_s) {
  return time_s ? fmt::format("{:.1f} us", *time_s * 1e6) : std::string("never");
}

std::string pause_line(const report::PauseMetrics& metrics) {
  return fmt::format(
      "friction learnt anew in {} pauses, {:.3g} % of the time; they raise the mean ratio by "
      "{:.2g}\n",
      metrics.pauses, 100.0 * metrics.time_fraction, metrics.ratio_cost);
}

std::string friction_line(const loop::FrictionBelief& belief, std::uint64_t dips) {
  const auto figure = [](const loop::Believed& each, const char* unit) {
    return fmt::format("{} ({} to {})", output::quantity(each.value, unit),
                       output::quantity(each.low_95, unit), output::quantity(each.high_95, unit));
  };
  return fmt::format(
      "friction learnt while driving, with 95 % intervals: Fc {}, contact stiffness {}, vibration "
      "{:.4g} ({:.4g} to {:.4g}) times the nominal one; the drive dipped {} {} for it\n",
      figure(belief.friction_force, "N"), figure(belief.contact_stiffness, "N/m"),
      belief.gain.value, belief.gain.low_95, belief.gain.high_95, dips,
      dips == 1 ? "time" : "times");
}

/// What a loop has learnt while driving, and its faults.
std::string learning_lines(const loop::RunResult& result, const RunFindings& findings) {
  std::string text;
  if (result.control->design.relearns) {
    text += pause_line(findings.pauses());
  }
  if (result.control->friction) {
    text += friction_line(*result.control->friction, findings.pauses().pauses);
  }
  for (const loop::FaultEvent& event : result.control->faults) {
    text += fmt::format("FAULT at {:.3f} ms: {}; the drive is off from there on\n",
                        event.time_s * 1e3, control::name(event.fault));
  }
  return text;
}

std::string step_lines(const scene::Scene& scene, const loop::RunResult& result,
                       const RunFindings& findings) {
  const AmplitudeUnit unit = amplitude_unit(scene);
  std::string text;
  const double calibration_s = scene.controller->calibration_s.value_or(0.0);
  if (calibration_s > 0.0) {
    text = fmt::format(
        "friction force learnt with the drive off until {:.3f} ms: the first settling time counts "
        "from there\n",
        calibration_s * 1e3);
  }
  text += warning_lines(calibration_notes(findings));
  if (const TextureMeter* texture = findings.texture()) {
    return text + texture_lines(scene, *texture) +
           warning_lines(texture_warnings(scene, *texture)) + learning_lines(result, findings);
  }
  const TargetUnit target = target_unit(scene);
  const int target_width = target.is_force() ? 10 : 7;
  const int ripple_width = target.is_force() ? 10 : 8;
  text += fmt::format("{:>11} {:>{}} {:>11} {:>10} {:>{}} {:>10}  {}\n", "from",
                      held_head(target, "target"), target_width, "settles in",
                      held_head(target, "error"), held_head(target, "ripple"), ripple_width,
                      "drive", "limit");
  for (const report::StepMetrics& step : findings.steps()) {
    text += fmt::format(
        "{:>8.3f} ms {:>{}} {:>11} {:>10} {:>{}} {:>8} {}  {}\n", step.time_s * 1e3,
        target_figure(target, step.target), target_width, settling(step.settling_time_s),
        error_figure(target, step.steady_error), width_figure(target, step.ripple), ripple_width,
        figure("{:.1f}", step.drive_amplitude_N * unit.per_N), unit.name, limit_text(step));
  }
  return text + learning_lines(result, findings);
}

std::string electrical_line(const loop::RunResult& result) {
  if (!result.electrical) {
    return {};
  }
  const loop::ElectricalFigures figures = loop::electrical_figures(*result.electrical);
  return fmt::format("{} V and {} A at most; {:.4g} W of {:.4g} VA, power factor {}\n",
                     figure("{:.4g}", figures.voltage_peak_V),
                     figure("{:.4g}", figures.current_peak_A), figures.active_power_W,
                     figures.apparent_power_VA, figure("{:.3g}", figures.power_factor));
}

std::string ratio_line(const scene::Scene& scene, const loop::RunResult& result,
                       const RunFindings& findings) {
  if (scene.friction.largest_limit_N() == 0.0) {
    return "no friction, so no friction ratio\n";
  }
  if (const auto sticks = stick_text(scene, findings)) {
    return *sticks + '\n';
  }
  return fmt::format("friction ratio {} over the whole run, {} from {:.6g} s on\n",
                     figure("{:.6f}", loop::power_ratios(scene, result.whole).friction_ratio),
                     figure("{:.6f}", loop::power_ratios(scene, result.window).friction_ratio),
                     scene.run.window_start_s);
}

std::string load_line(const scene::Scene& scene, const loop::RunResult& result) {
  return scene.load
             ? fmt::format("load at {:.6g} m, {:.6g} m/s\n", result.final_load_displacement_m,
                           result.final_state.load_velocity_m_per_s)
             : "";
}

}  // namespace

std::string run_text(const scene::Scene& scene, const loop::RunResult& result,
                     const RunFindings& findings) {
  const std::string lines = (scene.controller ? step_lines(scene, result, findings)
                                              : ratio_line(scene, result, findings)) +
                            load_line(scene, result) + electrical_line(result) +
                            warning_lines(run_notes(scene, result)) +
                            warning_lines(load_notes(scene, findings));
  return fmt::format("{}{}{:.6g} ms simulated with {} in {:.3g} ms, {:.3g} times real time\n",
                     lines, result.image ? image_lines(*result.image) : "",
                     result.final_time_s * 1e3, scene::name_of(scene.solver.method),
                     result.wall_s * 1e3, result.final_time_s / result.wall_s);
}

}  // namespace sonoglide::report
