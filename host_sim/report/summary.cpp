#include "host_sim/report/summary.hpp"

#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/solver_facts.hpp"
#include "host_sim/report/control_names.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/to_json.hpp"

namespace sonoglide::report {
namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json number(const std::optional<double>& value) {
  return value ? number(*value) : ordered_json(nullptr);
}

ordered_json power(const loop::PowerRatios& window) {
  return {{"pull_ratio", number(window.pull_ratio)},
          {"dissipation_ratio", number(window.dissipation_ratio)},
          {"drive_input_ratio", number(window.drive_input_ratio)},
          {"stored_change_ratio", number(window.stored_change_ratio)},
          {"damping_ratio", number(window.damping_ratio)},
          {"balance_residual", number(window.balance_residual)},
          {"as_printed", {{"dissipation_ratio", number(window.dissipation_as_printed)}}}};
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

ordered_json step(const report::StepMetrics& metrics) {
  return {{"time_s", metrics.time_s},
          {"target", metrics.target},
          {"settling_time_s", number(metrics.settling_time_s)},
          {"overshoot", number(metrics.overshoot)},
          {"steady_error", number(metrics.steady_error)},
          {"ripple", number(metrics.ripple)},
          {"drive_amplitude_N", number(metrics.drive_amplitude_N)},
          {"limit", limit_name(metrics.limit)},
          {"limit_seen_by", limit_seen_by(metrics)},
          {"cause", cause(metrics)},
          {"mismatch", number(metrics.mismatch)}};
}

ordered_json pauses(const report::PauseMetrics& metrics) {
  return {{"pauses", metrics.pauses},
          {"periods", metrics.periods},
          {"time_fraction", metrics.time_fraction},
          {"ratio_cost", metrics.ratio_cost}};
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

ordered_json control(const scene::Scene& scene, const loop::RunResult& result,
                     const RunFindings& findings) {
  const loop::ControlRecord& record = *result.control;
  const configure::ControlDesign& design = record.design;
  ordered_json steps = ordered_json::array();
  for (const report::StepMetrics& metrics : findings.steps()) {
    steps.push_back(step(metrics));
  }
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
      {"largest_tracking_error", number(findings.largest_tracking_error())},
      {"speed_floor_m_per_s", design.speed_floor * design.scales.velocity_m_per_s},
      {"integral_gain", design.integral_gain},
      {"signals", signals}};
  if (design.relearns) {
    json["relearning"] = pauses(findings.pauses());
  }
  return json;
}

ordered_json instructions(const loop::InstructionRange& range) {
  return {{"min", range.min}, {"mean", range.mean}, {"max", range.max}};
}

ordered_json image(const loop::ImageRecord& record) {
  ordered_json json = {{"board", record.board},
                       {"exchanges_per_second", number(record.exchanges_per_second)},
                       {"trace_hash_workstation", nullptr},
                       {"same_as_workstation", nullptr},
                       {"instructions_per_step", nullptr},
                       {"instructions_per_answer", nullptr},
                       {"flash_bytes", record.flash_bytes},
                       {"ram_bytes", record.ram_bytes},
                       {"stack_bytes_bound", nullptr}};
  if (record.workstation) {
    json["trace_hash_workstation"] = fmt::format("{:016x}", record.workstation->trace_hash);
    json["same_as_workstation"] = record.workstation->same;
  }
  if (record.instructions) {
    json["instructions_per_step"] = instructions(record.instructions->step);
    json["instructions_per_answer"] = instructions(record.instructions->answer);
  }
  if (record.stack_bytes_bound) {
    json["stack_bytes_bound"] = *record.stack_bytes_bound;
  } else {
    json["stack_unbounded_by"] = record.stack_unbounded_by;
  }
  return json;
}

}  // namespace

ordered_json summary(const scene::Scene& scene, const loop::RunResult& result,
                     const RunFindings& findings) {
  const loop::PowerRatios window = loop::power_ratios(scene, result.window);
  ordered_json json;
  json["scene"] = scene_file::to_json(scene);
  json["solver"] = {
      {"method", configure::name_of(scene.solver.method)},
      {"steps", result.solver_steps},
      {"events", configure::counts_events(scene.solver.method) ? ordered_json(result.solver_events)
                                                               : ordered_json(nullptr)}};
  json["run"] = {{"simulated_s", result.final_time_s},
                 {"wall_s", result.wall_s},
                 {"real_time_factor", result.final_time_s / result.wall_s}};
  json["final"] = {{"time_s", result.final_time_s},
                   {"displacement_m", result.final_state.displacement_m},
                   {"velocity_m_per_s", result.final_state.velocity_m_per_s},
                   {"friction_force_N", result.final_state.friction_force_N}};
  json["friction_ratio"] = {
      {"whole_run", number(loop::power_ratios(scene, result.whole).friction_ratio)},
      {"window", number(window.friction_ratio)}};
  json["power"] = power(window);
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

std::string summary_text(const scene::Scene& scene, const loop::RunResult& result,
                         const RunFindings& findings) {
  constexpr int indent = 2;
  return summary(scene, result, findings)
             .dump(indent, ' ', false, ordered_json::error_handler_t::replace) +
         "\n";
}

}  // namespace sonoglide::report
