#include "host_sim/report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/output/program.hpp"
#include "host_sim/report/run_notes.hpp"
#include "host_sim/report/run_parts.hpp"
#include "host_sim/report/self_excitation.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene_file/echo.hpp"

namespace sonoglide::report {
namespace {

using nlohmann::ordered_json;

ordered_json power(const loop::PowerRatios& window, bool has_load) {
  ordered_json json = {
      {"pull_ratio", output::json_number(window.pull_ratio)},
      {"dissipation_ratio", output::json_number(window.dissipation_ratio)},
      {"drive_input_ratio", output::json_number(window.drive_input_ratio)},
      {"stored_change_ratio", output::json_number(window.stored_change_ratio)},
      {"damping_ratio", output::json_number(window.damping_ratio)},
      {"balance_residual", output::json_number(window.balance_residual)},
      {"as_printed", {{"dissipation_ratio", output::json_number(window.dissipation_as_printed)}}}};
  if (has_load) {
    json["load_force_ratio"] = output::json_number(window.load_force_ratio);
    json["load_spring_pull_ratio"] = output::json_number(window.load_spring_pull_ratio);
    json["load_damping_ratio"] = output::json_number(window.load_damping_ratio);
    json["load_stored_change_ratio"] = output::json_number(window.load_stored_change_ratio);
  }
  return json;
}

ordered_json load(const loop::RunResult& result) {
  const loop::LoadBalance& window = result.window.load;
  return {{"final_velocity_m_per_s", result.final_state.load_velocity_m_per_s},
          {"final_displacement_m", result.final_load_displacement_m},
          {"force_work_J", window.force_work_J},
          {"spring_pull_work_J", window.spring_pull_work_J},
          {"damping_work_J", window.damping_work_J},
          {"stored_change_J", window.change_J()}};
}

ordered_json electrical(const loop::ElectricalFigures& figures) {
  return {{"voltage_peak_V", output::json_number(figures.voltage_peak_V)},
          {"current_peak_A", output::json_number(figures.current_peak_A)},
          {"active_power_W", output::json_number(figures.active_power_W)},
          {"reactive_power_var", output::json_number(figures.reactive_power_var)},
          {"apparent_power_VA", output::json_number(figures.apparent_power_VA)},
          {"power_factor", output::json_number(figures.power_factor)},
          {"balance_residual", output::json_number(figures.balance_residual)}};
}

ordered_json steady_orbit(const loop::SteadyOrbit& orbit) {
  return {{"displacement_m", orbit.state.displacement_m},
          {"velocity_m_per_s", orbit.state.velocity_m_per_s},
          {"friction_force_N", orbit.state.friction_force_N},
          {"multiplier", orbit.multiplier},
          {"carrier_periods_solved", orbit.periods}};
}

ordered_json limit_seen_by(const report::StepMetrics& metrics) {
  if (metrics.limit == control::Limit::none) {
    return nullptr;
  }
  return metrics.limit_seen_by_controller ? "controller" : "simulation";
}

ordered_json cause(const report::StepMetrics& metrics) {
  return metrics.cause == control::Settling::pending ? ordered_json(nullptr)
                                                     : ordered_json(settling_name(metrics.cause));
}

void add_vibration(const report::StepMetrics& step, ordered_json& json) {
  if (step.vibration) {
    json["vibration_velocity_m_per_s"] = output::json_number(step.vibration->velocity_m_per_s);
    json["velocity_settling_time_s"] = output::json_number(step.vibration->settling_time_s);
  }
  if (step.resonance) {
    json["frequency_Hz"] = output::json_number(step.resonance->frequency_Hz);
    json["frequency_error"] = output::json_number(step.resonance->frequency_error);
  }
}

ordered_json step(const report::StepMetrics& metrics, const TargetUnit& target,
                  const AmplitudeUnit& unit) {
  const auto held = [&target](const char* name) {
    return fmt::format("{}{}", name, target.suffix);
  };
  const auto sized = [&target](double part) { return output::json_number(part * target.size); };
  ordered_json json = {
      {"time_s", metrics.time_s},
      {target.is_force() ? "target_force_N" : "target", metrics.target * target.size},
      {"settling_time_s", output::json_number(metrics.settling_time_s)},
      {held("overshoot"), sized(metrics.overshoot)},
      {held("steady_error"), sized(metrics.steady_error)},
      {held("ripple"), sized(metrics.ripple)},
      {fmt::format("drive_amplitude_{}", unit.name),
       output::json_number(metrics.drive_amplitude_N * unit.per_N)},
      {"limit", limit_name(metrics.limit)},
      {"limit_seen_by", limit_seen_by(metrics)},
      {"cause", cause(metrics)},
      {"mismatch", output::json_number(metrics.mismatch)}};
  if (metrics.least_friction) {
    json["least_friction"] = {{"ratio", metrics.least_friction->ratio},
                              {"vibration_m_per_s", metrics.least_friction->vibration_m_per_s}};
  }
  add_vibration(metrics, json);
  return json;
}

ordered_json pauses(const report::PauseMetrics& metrics) {
  return {{"pauses", metrics.pauses},
          {"periods", metrics.periods},
          {"time_fraction", metrics.time_fraction},
          {"ratio_cost", metrics.ratio_cost}};
}

ordered_json believed(const loop::Believed& figure) {
  return {{"value", figure.value}, {"low_95", figure.low_95}, {"high_95", figure.high_95}};
}

ordered_json friction(const loop::FrictionBelief& belief) {
  return {{"Fc_N", believed(belief.friction_force)},
          {"contact_stiffness_N_per_m", believed(belief.contact_stiffness)},
          {"gain", believed(belief.gain)}};
}

ordered_json limited_periods(const Course& course) {
  ordered_json json = ordered_json::object();
  for (std::size_t i = 1; i < control::limit_count; ++i) {
    const auto limit = static_cast<control::Limit>(i);
    json[limit_name(limit)] = course.periods_in(limit);
  }
  return json;
}

ordered_json signal(const numeric::SignalRecord& record) {
  return {{"name", record.name},
          {"smallest", record.smallest},
          {"largest", record.largest},
          {"saturations", record.saturations}};
}

std::vector<std::string> notes(const scene::Scene& scene, const loop::RunResult& result,
                               const RunFindings& findings) {
  std::vector<std::string> all = configure::design_notes(result.control->design);
  for (std::vector<std::string>& more :
       std::array{self_excitation_notes(scene), target_notes(scene), run_notes(scene, result),
                  load_notes(scene, findings)}) {
    std::move(more.begin(), more.end(), std::back_inserter(all));
  }
  return all;
}

ordered_json contact(const scene::Scene& scene, const loop::RunResult& result) {
  const ContactLoadFigures load = contact_load(result.window);
  return {{"open_fraction", load.open_fraction},
          {"mean_normal_force_N", load.mean_normal_force_N},
          {"notes", run_notes(scene, result)}};
}

ordered_json control(const scene::Scene& scene, const loop::RunResult& result,
                     const RunFindings& findings) {
  const loop::ControlRecord& record = *result.control;
  const configure::ControlDesign& design = record.design;
  const TargetUnit target = target_unit(scene);
  ordered_json steps = ordered_json::array();
  for (const report::StepMetrics& metrics : findings.steps()) {
    steps.push_back(step(metrics, target, amplitude_unit(scene)));
  }
  const std::optional<double> tracking_error = findings.largest_tracking_error();
  ordered_json faults = ordered_json::array();
  for (const loop::FaultEvent& event : record.faults) {
    faults.push_back({{"time_s", event.time_s}, {"cause", fault_name(event.fault)}});
  }
  ordered_json signals = ordered_json::array();
  for (const numeric::SignalRecord& entry : record.signals) {
    signals.push_back(signal(entry));
  }
  ordered_json json = {
      {"arithmetic", scene::name_of(scene::arithmetics, scene.controller->arithmetic)},
      {"trace_hash", fmt::format("{:016x}", record.trace_hash)},
      {"saturated_fraction", record.commands == 0 ? 0.0
                                                  : static_cast<double>(record.saturated_commands) /
                                                        static_cast<double>(record.commands)},
      {"limited_periods", limited_periods(findings.course())},
      {"faults", faults},
      {"steps", steps},
      {fmt::format("largest_tracking_error{}", target.suffix),
       output::json_number(tracking_error ? std::optional(*tracking_error * target.size)
                                          : std::nullopt)},
      {"speed_floor_m_per_s", design.speed_floor * design.scales.velocity_m_per_s},
      {"integral_gain", design.senses_force ? design.integral_gain : 0.0},
      {"signals", signals},
      {"notes", notes(scene, result, findings)}};
  if (const TextureMeter* texture = findings.texture()) {
    json["texture_periods"] = texture->passes();
    json["texture"] = texture_json(*texture, target);
  }
  if (scene.sensor.vibration) {
    json["vibration_full_scale_m_per_s"] = design.scales.velocity_m_per_s;
  }
  if (design.bias) {
    json["bias"] = {{"part", design.bias->part}, {"largest_N", findings.course().largest_bias_N()}};
  }
  if (design.relearns || design.tracks) {
    json["relearning"] = pauses(findings.pauses());
  }
  if (record.friction) {
    json["friction"] = friction(*record.friction);
  }
  return json;
}

ordered_json instructions(const loop::InstructionRange& range) {
  return {{"min", range.min}, {"mean", range.mean}, {"max", range.max}};
}

ordered_json image(const loop::ImageRecord& record) {
  ordered_json json = {{"board", record.board},
                       {"exchanges_per_second", output::json_number(record.exchanges_per_second)},
                       {"trace_hash_workstation", nullptr},
                       {"same_as_workstation", nullptr},
                       {"instructions_per_step", nullptr},
                       {"instructions_per_answer", nullptr},
                       {"flash_bytes", nullptr},
                       {"ram_bytes", nullptr},
                       {"stack_bytes_bound", nullptr}};
  if (record.workstation) {
    json["trace_hash_workstation"] = fmt::format("{:016x}", record.workstation->trace_hash);
    json["same_as_workstation"] = record.workstation->same;
  }
  if (record.instructions) {
    json["instructions_per_step"] = instructions(record.instructions->step);
    json["instructions_per_answer"] = instructions(record.instructions->answer);
  }
  if (record.memory) {
    json["flash_bytes"] = record.memory->flash_bytes;
    json["ram_bytes"] = record.memory->ram_bytes;
    if (record.memory->stack_bytes_bound) {
      json["stack_bytes_bound"] = *record.memory->stack_bytes_bound;
    } else {
      json["stack_unbounded_by"] = record.memory->stack_unbounded_by;
    }
  }
  return json;
}

}  // namespace

ordered_json summary(const configure::Experiment& experiment, const loop::RunResult& result,
                     const RunFindings& findings) {
  const scene::Scene& scene = experiment.plant;
  const loop::PowerRatios window = loop::power_ratios(scene, result.window);
  ordered_json json;
  json["program"] = output::program_json();
  json["scene"] = scene_file::to_json(experiment.nominal);
  json["solver"] = {
      {"method", scene::name_of(scene.solver.method)},
      {"steps", result.solver_steps},
      {"events", scene::counts_events(scene.solver.method) ? ordered_json(result.solver_events)
                                                           : ordered_json(nullptr)}};
  json["run"] = {{"simulated_s", result.final_time_s},
                 {"wall_s", result.wall_s},
                 {"real_time_factor", result.final_time_s / result.wall_s}};
  json["final"] = {{"time_s", result.final_time_s},
                   {"displacement_m", result.final_state.displacement_m},
                   {"velocity_m_per_s", result.final_state.velocity_m_per_s},
                   {"friction_force_N", result.final_state.friction_force_N}};
  const auto ratio = [&](double of) {
    return stick_text(scene, findings) ? ordered_json(nullptr) : output::json_number(of);
  };
  json["friction_ratio"] = {
      {"whole_run", ratio(loop::power_ratios(scene, result.whole).friction_ratio)},
      {"window", ratio(window.friction_ratio)}};
  json["power"] = power(window, scene.load.has_value());
  if (scene.load) {
    json["load"] = load(result);
  }
  if (scene::is<scene::laws::NormalCoulomb>(scene.friction.law)) {
    json["contact"] = contact(scene, result);
  }
  if (result.electrical) {
    json["electrical"] = electrical(loop::electrical_figures(*result.electrical));
  }
  if (result.steady_orbit) {
    json["steady_orbit"] = steady_orbit(*result.steady_orbit);
  }
  if (result.control) {
    json["control"] = control(scene, result, findings);
  }
  if (result.image) {
    json["pil"] = image(*result.image);
  }
  return json;
}

std::string summary_text(const configure::Experiment& experiment, const loop::RunResult& result,
                         const RunFindings& findings) {
  constexpr int indent = 2;
  return summary(experiment, result, findings)
             .dump(indent, ' ', false, ordered_json::error_handler_t::replace) +
         "\n";
}

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
                        event.time_s * 1e3, fault_name(event.fault));
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
