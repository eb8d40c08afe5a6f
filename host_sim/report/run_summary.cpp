#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/control/interface/names.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/output/program.hpp"
#include "host_sim/report/run_notes.hpp"
#include "host_sim/report/run_parts.hpp"
#include "host_sim/report/run_report.hpp"
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
                                                     : ordered_json(control::name(metrics.cause));
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
      {"limit", control::name(metrics.limit)},
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
    json[control::name(limit)] = course.periods_in(limit);
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
    faults.push_back({{"time_s", event.time_s}, {"cause", control::name(event.fault)}});
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
    json["pil"] = image_json(*result.image);
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

}  // namespace sonoglide::report
