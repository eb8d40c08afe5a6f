#include "host_sim/report/run_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

#include "firmware/control/interface/names.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/report/run_notes.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/key.hpp"

namespace sonoglide::report {
namespace {

std::string percent(double part) {
  return fmt::format("{:.3g} %", 100.0 * part);
}

/// Of the limits that no other warning speaks of.
void append_limits(const Course& course, std::vector<std::string>& warnings) {
  using control::Limit;
  for (const Limit limit : {Limit::slew, Limit::ratio_end, Limit::mismatch, Limit::not_settling,
                            Limit::bad_sample, Limit::frequency_range}) {
    if (const std::uint64_t periods = course.periods_in(limit); periods > 0) {
      warnings.push_back(fmt::format("The controller named the limit {} in {} carrier {}.",
                                     control::name(limit), periods,
                                     periods == 1 ? "period" : "periods"));
    }
  }
}

void append_drive_limit(const scene::Scene& scene, const loop::ControlRecord& control,
                        std::vector<std::string>& warnings) {
  if (control.saturated_commands == 0) {
    return;
  }
  const AmplitudeUnit unit = amplitude_unit(scene);
  const std::string part = percent(static_cast<double>(control.saturated_commands) /
                                   static_cast<double>(control.commands));
  const double most = scene.max_drive_force_N() * unit.per_N;
  if (control.design.resonance() == nullptr) {
    warnings.push_back(
        fmt::format("The actuator's range of 0 to {:.6g} {} limited the drive in {} of the control "
                    "steps.",
                    most, unit.name, part));
    return;
  }
  const auto& current_A = scene.drive->max_current_amplitude_A;
  warnings.push_back(
      fmt::format("The amplifier's {:.6g} V{} limited the drive in {} of the control steps. In a "
                  "large change of the vibration this is intended.",
                  most, current_A ? fmt::format(" or {:.6g} A", *current_A) : "", part));
}

/// Of each step that never settles, whoever found it out.
void append_unsettled(const scene::Scene& scene, const RunFindings& findings,
                      std::vector<std::string>& warnings) {
  constexpr std::size_t most_told = 12;
  const TargetUnit unit = target_unit(scene);
  const char* const newtons = unit.is_force() ? " N" : "";
  std::size_t unsettled = 0;
  for (const StepMetrics& step : findings.steps()) {
    if (step.settling_time_s || ++unsettled > most_told) {
      continue;
    }
    warnings.push_back(fmt::format(
        "The step to {:.3g}{} at {:.6g} ms never settles: the friction {} does not stay within "
        "{:.3g}{} of the target{}. Limit: {}.",
        step.target * unit.size, newtons, step.time_s * 1e3, unit.is_force() ? "force" : "ratio",
        scene.run.settling_band * unit.size, newtons,
        std::isnan(step.steady_error)
            ? ""
            : fmt::format(" (mean of the last quarter {:.4g}{})",
                          (step.target + step.steady_error) * unit.size, newtons),
        limit_text(step)));
  }
  if (unsettled > most_told) {
    warnings.push_back(
        fmt::format("{} more steps never settle: see the table.", unsettled - most_told));
  }
}

}  // namespace

std::vector<std::string> calibration_notes(const RunFindings& findings) {
  constexpr double steady = 0.05;
  const CalibrationMetrics seen = findings.calibration();
  if (!(seen.highest - seen.lowest > steady)) {
    return {};
  }
  return {fmt::format(
      "While the friction force was learnt with the drive off, the friction was {:.3g} to {:.3g} times "
      "that of steady sliding: the contact sticks and slips, or has not slid through its presliding "
      "travel yet. What is learnt is not its level. Without controller.calibration_s the scene's is "
      "trusted.",
      seen.lowest, seen.highest)};
}

std::vector<std::string> load_notes(const scene::Scene& scene, const RunFindings& findings) {
  const double fastest_m_per_s = findings.course().fastest_m_per_s();
  if (!scene.load || fastest_m_per_s <= scene_file::largest_speed_m_per_s) {
    return {};
  }
  return {fmt::format(
      "The load reached {:.4g} m/s. No velocity of a scene may be beyond {:g} m/s, and the figures of "
      "a faster one are not to be trusted.",
      fastest_m_per_s, scene_file::largest_speed_m_per_s)};
}

std::optional<std::string> stick_text(const scene::Scene& scene, const RunFindings& findings) {
  const bool shaken = scene.controller || (scene.drive && scene.drive_force_N() != 0.0);
  if (!scene.load || shaken || !scene::is_elastic(scene.friction.law) ||
      scene.friction.has_profile()) {
    return std::nullopt;
  }
  const double travel_m = findings.course().travel_m();
  const double elastic_m = scene.friction.limit_N() / scene.friction.contact_stiffness_N_per_m;
  if (!(travel_m < elastic_m)) {
    return std::nullopt;
  }
  return fmt::format(
      "The contact sticks: the load moves within {}, and the contact yields by {} before it slides. "
      "There is no friction ratio.",
      output::quantity(travel_m, "m"), output::quantity(elastic_m, "m"));
}

std::vector<std::string> run_warnings(const scene::Scene& scene, const loop::RunResult& result,
                                      const RunFindings& findings) {
  std::vector<std::string> all;
  if (scene.friction.sign_convention == scene::SignConvention::as_printed) {
    all.emplace_back(
        "Sign convention as printed in the paper (V = Vt - x'): friction pumps energy into the "
        "vibration. The dissipative convention is V = Vt + x'.");
  }
  for (std::vector<std::string>& notes :
       std::array{target_notes(scene), run_notes(scene, result), load_notes(scene, findings)}) {
    std::move(notes.begin(), notes.end(), std::back_inserter(all));
  }
  if (!result.control) {
    return all;
  }
  for (std::string& note : calibration_notes(findings)) {
    all.push_back(std::move(note));
  }
  append_unsettled(scene, findings, all);
  if (const TextureMeter* texture = findings.texture()) {
    for (std::string& warning : texture_warnings(scene, *texture)) {
      all.push_back(std::move(warning));
    }
  }
  for (const loop::FaultEvent& event : result.control->faults) {
    all.push_back(fmt::format("Fault at {:.6g} ms: {}. The drive is off from there on.",
                              event.time_s * 1e3, control::name(event.fault)));
  }
  append_drive_limit(scene, *result.control, all);
  if (!scene.sensor.force) {
    all.emplace_back(
        "There is no force sensor: the controller computes the friction ratio from the nominal "
        "friction, and cannot detect an error of it.");
  }
  append_limits(findings.course(), all);
  if (findings.course().periods_in(control::Limit::speed_floor) > 0) {
    const configure::ControlDesign& design = result.control->design;
    all.push_back(
        fmt::format("The drive was held while sliding was slower than {:.3g} mm/s, where "
                    "the friction ratio is undefined.",
                    1e3 * design.speed_floor * design.scales.velocity_m_per_s));
  }
  if (findings.course().periods_in(control::Limit::velocity_at_rail) > 0) {
    all.push_back(fmt::format(
        "The drive was held, and then taken to zero, while the velocity sensor stood at the end of "
        "its range, {:.3g} m/s, which is the velocity of the largest vibration.",
        result.control->design.scales.velocity_m_per_s));
  }
  return all;
}

std::vector<std::string> run_remarks(const scene::Scene& scene, const loop::RunResult& result,
                                     const RunFindings& findings) {
  std::vector<std::string> all;
  if (const auto sticks = stick_text(scene, findings)) {
    all.push_back(*sticks);
  }
  if (!result.control) {
    return all;
  }
  if (!scene.tolerances.empty()) {
    all.emplace_back(
        "This run has one plant and ignores [tolerance]. The command robust runs the loop over the "
        "plants within it.");
  }
  if (scene.drive->waveform != scene::Waveform::cosine) {
    all.emplace_back(
        "The feedforward's map is that of the contact under a cosine; feedback corrects what the "
        "waveform changes.");
  }
  for (std::string& note : configure::design_notes(result.control->design)) {
    all.push_back(std::move(note));
  }
  if (result.control->design.relearns) {
    const report::PauseMetrics pauses = findings.pauses();
    all.push_back(fmt::format(
        "The drive paused {} times to calibrate the friction force again: {} of the time. The "
        "pauses raise the mean friction ratio by {:.3g}; the table of target steps leaves them out.",
        pauses.pauses, percent(pauses.time_fraction), pauses.ratio_cost));
  }
  if (result.control->friction) {
    const report::PauseMetrics dips = findings.pauses();
    all.push_back(fmt::format(
        "The intervals of the learnt friction hold in 95 % of plants within the assumed errors, if "
        "their friction stands still. The drive dipped {} {} to measure the friction force, {} of "
        "the time; the table of target steps leaves these periods out.",
        dips.pauses, dips.pauses == 1 ? "time" : "times", percent(dips.time_fraction)));
  }
  if (scene.controller->targets().size() > findings.close_ups().size()) {
    all.push_back(fmt::format("Close-ups are shown of the first {} target steps.",
                              findings.close_ups().size()));
  }
  return all;
}

}  // namespace sonoglide::report
