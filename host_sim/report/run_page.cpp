#include "host_sim/report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/report/run_notes.hpp"
#include "host_sim/report/spectrum.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene_file/to_json.hpp"

namespace sonoglide::report {
namespace {

constexpr const char* time_label = "Time [s]";
using output::Line;

std::string percent(double part) {
  return fmt::format("{:.3g} %", 100.0 * part);
}

std::string lead(const scene::Scene& scene, const loop::RunResult& result) {
  std::string text =
      scene.controller
          ? fmt::format("Closed loop, controller in {}",
                        scene::name_of(scene::arithmetics, scene.controller->arithmetic))
          : std::string("Open loop");
  text += fmt::format(". Friction law: {}. Solver: {}. {:.6g} ms simulated in {:.3g} ms.",
                      scene::name_of(scene.friction.law), scene::name_of(scene.solver.method),
                      result.final_time_s * 1e3, result.wall_s * 1e3);
  return text;
}

/// Of the limits that no other warning speaks of.
void append_limits(const Course& course, std::vector<std::string>& warnings) {
  using control::Limit;
  for (const Limit limit : {Limit::slew, Limit::ratio_end, Limit::mismatch, Limit::not_settling,
                            Limit::bad_sample, Limit::frequency_range}) {
    if (const std::uint64_t periods = course.periods_in(limit); periods > 0) {
      warnings.push_back(fmt::format("The controller named the limit {} in {} carrier {}.",
                                     limit_name(limit), periods,
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

std::vector<std::string> warnings(const scene::Scene& scene, const loop::RunResult& result,
                                  const RunFindings& findings) {
  std::vector<std::string> all;
  if (scene.friction.sign_convention == scene::SignConvention::as_printed) {
    all.emplace_back(
        "Sign convention as printed in the paper (V = Vt - x'): friction pumps energy into the "
        "vibration. The dissipative convention is V = Vt + x'.");
  }
  for (std::string& note : run_notes(scene, result)) {
    all.push_back(std::move(note));
  }
  if (!result.control) {
    return all;
  }
  if (!scene.tolerances.empty()) {
    all.emplace_back(
        "This run has one plant and ignores [tolerance]. The command robust runs the loop over the "
        "plants within it.");
  }
  const bool cosine = scene.drive->waveform == scene::Waveform::cosine;
  if (!scene::has_own_map(scene.friction.law) || !cosine) {
    all.push_back(fmt::format(
        "The feedforward's map is that of a {} contact under a cosine; feedback corrects what {} "
        "changes.",
        scene::friction_map(scene.friction.law) == scene::FrictionMap::dahl ? "Dahl" : "Coulomb",
        cosine ? "the law" : "the waveform"));
  }
  for (const loop::FaultEvent& event : result.control->faults) {
    all.push_back(fmt::format("Fault at {:.6g} ms: {}. The drive is off from there on.",
                              event.time_s * 1e3, fault_name(event.fault)));
  }
  append_drive_limit(scene, *result.control, all);
  if (!scene.sensor.force) {
    all.emplace_back(
        "There is no force sensor: the controller computes the friction ratio from the nominal "
        "friction, and cannot detect an error of it.");
  }
  append_limits(findings.course(), all);
  for (std::string& note : configure::design_notes(result.control->design)) {
    all.push_back(std::move(note));
  }
  if (result.control->design.relearns) {
    const report::PauseMetrics pauses = findings.pauses();
    all.push_back(fmt::format(
        "The drive paused {} times to calibrate the friction force again: {} of the "
        "time. The pauses raise the mean friction ratio by {:.3g}; the table of target steps leaves them out.",
        pauses.pauses, percent(pauses.time_fraction), pauses.ratio_cost));
  }
  if (scene.controller->target_friction_ratio.size() > findings.close_ups().size()) {
    all.push_back(fmt::format("Close-ups are shown of the first {} target steps.",
                              findings.close_ups().size()));
  }
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
        "its range, {:.3g} m/s. No vibration of this drive is faster.",
        result.control->design.scales.velocity_m_per_s));
  }
  return all;
}

output::Table step_table(const scene::Scene& scene, const RunFindings& findings) {
  const AmplitudeUnit unit = amplitude_unit(scene);
  output::Table table{"Target steps",
                      {"From [ms]", "Target", "Settles in [µs]", "Overshoot", "Steady error",
                       "Ripple", fmt::format("Drive [{}]", unit.name), "Limit"},
                      {}};
  for (const report::StepMetrics& step : findings.steps()) {
    table.rows.push_back(
        {fmt::format("{:.3f}", step.time_s * 1e3), fmt::format("{:.3f}", step.target),
         step.settling_time_s ? fmt::format("{:.1f}", *step.settling_time_s * 1e6) : "never",
         figure("{:.5f}", step.overshoot), figure("{:+.5f}", step.steady_error),
         figure("{:.5f}", step.ripple), figure("{:.1f}", step.drive_amplitude_N * unit.per_N),
         limit_text(step)});
  }
  return table;
}

output::Table vibration_table(const RunFindings& findings) {
  output::Table table{"Vibration", {"From [ms]", "Velocity [mm/s]", "Settles to 2 % in [µs]"}, {}};
  const std::vector<report::StepMetrics>& steps = findings.steps();
  if (!steps.empty() && steps.front().resonance) {
    table.title = "Vibration at resonance";
    table.header.insert(table.header.end(),
                        {"Frequency [Hz]", "Largest deviation from the natural frequency"});
  }
  for (const report::StepMetrics& step : steps) {
    const report::VibrationMetrics& vibration = *step.vibration;
    const char* unsettled = step.target < 1.0 ? "never" : "-";  // at 1 no vibration is wanted
    std::vector<std::string> row{fmt::format("{:.3f}", step.time_s * 1e3),
                                 figure("{:.4f}", vibration.velocity_m_per_s * 1e3),
                                 vibration.settling_time_s
                                     ? fmt::format("{:.1f}", *vibration.settling_time_s * 1e6)
                                     : unsettled};
    if (step.resonance) {
      row.push_back(figure("{:.3f}", step.resonance->frequency_Hz));
      row.push_back(figure("{:.1e}", step.resonance->frequency_error));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

output::Table run_table(const scene::Scene& scene, const loop::RunResult& result) {
  const loop::PowerRatios window = loop::power_ratios(scene, result.window);
  output::Table table{"Run", {}, {}};
  const auto row = [&table](const char* name, std::string value) {
    table.rows.push_back({name, std::move(value)});
  };
  row("Undriven friction force, window [N]",
      fmt::format("{:.6g}", scene.friction.largest_limit_N() * result.window.undriven_s /
                                result.window.duration_s));
  if (scene.friction.largest_limit_N() > 0.0) {
    row("Friction ratio, whole run",
        fmt::format("{:.9f}", loop::power_ratios(scene, result.whole).friction_ratio));
    row("Friction ratio, window", fmt::format("{:.9f}", window.friction_ratio));
    row("Power of the pull over that of the friction limit, window",
        fmt::format("{:.6f}", window.pull_ratio));
    row("Power dissipation ratio, window", fmt::format("{:.6f}", window.dissipation_ratio));
    row("Drive input ratio, window", fmt::format("{:.6f}", window.drive_input_ratio));
    row("Change of stored energy, window", fmt::format("{:.6f}", window.stored_change_ratio));
    row("Damping, window", fmt::format("{:.6f}", window.damping_ratio));
  }
  if (scene::is<scene::laws::NormalCoulomb>(scene.friction.law)) {
    const ContactLoadFigures load = contact_load(result.window);
    row("Part of the time without contact, window", fmt::format("{:.6f}", load.open_fraction));
    row("Mean normal force, window [N]", fmt::format("{:.6g}", load.mean_normal_force_N));
  }
  row("Residual of the energy balance, window", figure("{:.2g}", window.balance_residual));
  if (std::isfinite(window.dissipation_as_printed)) {
    row("Power dissipation ratio as the paper prints it",
        fmt::format("{:.6g}", window.dissipation_as_printed));
  }
  if (result.steady_orbit) {
    row("Steady orbit: carrier periods solved to find it",
        fmt::format("{}", result.steady_orbit->periods));
    row("Steady orbit: part of a deviation that is left after a carrier period",
        fmt::format("{:.6f}", result.steady_orbit->multiplier));
  }
  row("Solver steps", fmt::format("{}", result.solver_steps));
  if (scene::counts_events(scene.solver.method)) {
    row("Reversals, sticks and releases", fmt::format("{}", result.solver_events));
  }
  row("Simulated time over wall time", fmt::format("{:.3g}", result.final_time_s / result.wall_s));
  return table;
}

output::Table electrical_table(const loop::ElectricalBalance& balance) {
  const loop::ElectricalFigures figures = loop::electrical_figures(balance);
  return {
      "Transducer, window",
      {},
      {{"Largest voltage amplitude [V]", figure("{:.6g}", figures.voltage_peak_V)},
       {"Largest current amplitude, fundamental [A]", figure("{:.6g}", figures.current_peak_A)},
       {"Active power [W]", fmt::format("{:.6g}", figures.active_power_W)},
       {"Reactive power, below 0 capacitive [var]",
        fmt::format("{:.6g}", figures.reactive_power_var)},
       {"Apparent power [VA]", fmt::format("{:.6g}", figures.apparent_power_VA)},
       {"Power factor", figure("{:.6f}", figures.power_factor)},
       {"Residual of the electrical balance", fmt::format("{:.2g}", figures.balance_residual)}}};
}

output::Table signal_table(const loop::ControlRecord& control) {
  output::Table table{
      "Fixed-point signals, per unit", {"Signal", "Smallest", "Largest", "Saturations"}, {}};
  for (const numeric::SignalRecord& signal : control.signals) {
    table.rows.push_back({signal.name, fmt::format("{:.6f}", signal.smallest),
                          fmt::format("{:.6f}", signal.largest),
                          fmt::format("{}", signal.saturations)});
  }
  return table;
}

std::string course_text(const scene::Scene& scene, const Course::Curve& curve) {
  if (!scene.drive) {
    return "One value for each thousandth of the run.";
  }
  if (curve.piece_size() == 1) {
    return "One value for each carrier period.";
  }
  return fmt::format("Smallest and largest value of every {} carrier periods.{}",
                     curve.piece_size(),
                     scene.run.record.empty() ? "" : " All of them are in periods.csv.");
}

std::vector<double> limits_N(const scene::Friction& friction, const std::vector<double>& time_s) {
  std::vector<double> limits;
  limits.reserve(time_s.size());
  for (const double time : time_s) {
    limits.push_back(configure::contact_at(friction, time).limit_N());
  }
  return limits;
}

/// A line at a value.
output::Curve level(const char* label, const std::vector<double>& x, double value) {
  return {label, std::vector<double>(x.size(), value)};
}

/// Over the time of the whole run, which all such charts show together.
output::Chart course_chart(const char* title, const char* note, const std::string& label,
                           const std::vector<double>& time, std::vector<output::Curve> curves) {
  return {title, note, {time_label}, {label}, time, std::move(curves), "course"};
}

output::Section course(const scene::Scene& scene, const Course::Curve& curve) {
  const std::vector<double> time = curve.x();
  const auto series = [&curve](const char* label, Course::Ordinate ordinate) {
    return output::Curve{label, curve.y(ordinate), Line::stepped};
  };

  output::Section section{"Course of the run", course_text(scene, curve), {}};
  const auto add = [&](const char* title, const char* note, const std::string& label,
                       std::vector<output::Curve> curves) {
    section.charts.push_back(course_chart(title, note, label, time, std::move(curves)));
  };
  if (scene.friction.largest_limit_N() > 0.0) {
    std::vector<output::Curve> ratios;
    if (scene.controller) {
      ratios.push_back(series("target", Course::target));
    }
    ratios.push_back(series("reached", Course::friction_ratio));
    add("Friction ratio",
        "Mean friction force over a carrier period, divided by the undriven one at that "
        "sliding speed and friction.",
        "Friction ratio [-]", std::move(ratios));
  }
  if (scene.friction.has_profile()) {
    add("Friction limit", "", "Coefficient times normal force [N]",
        {{"limit", limits_N(scene.friction, time), Line::stepped}});
  }
  if (scene.drive) {
    const AmplitudeUnit unit = amplitude_unit(scene);
    const double most = scene.max_drive_force_N() * unit.per_N;
    std::vector<output::Curve> amplitudes = {
        {"amplitude", unit.of(curve.y(Course::drive_amplitude_N)), Line::stepped}};
    if (scene.resonant()) {
      amplitudes.push_back(level("limit", time, most));
      amplitudes.push_back(level("limit, phase turned", time, -most));
    }
    add("Drive amplitude", scene.resonant() ? "Below 0 the phase is turned by π." : "",
        fmt::format("Drive {} amplitude [{}]", scene.transducer ? "voltage" : "force", unit.name),
        std::move(amplitudes));
  }
  if (scene.sliding.profile.size() > 1) {
    add("Sliding velocity", "", "Sliding velocity [m/s]",
        {series("sliding", Course::sliding_velocity_m_per_s)});
  }
  return section;
}

output::Section vibration_section(const scene::Scene& scene, const VibrationCourse::Curve& curve) {
  const std::vector<double> time = curve.x();
  output::Section section{scene.transducer ? "Vibration and current" : "Vibration",
                          "Fundamental of each carrier period.",
                          {}};
  const auto panel = [&](const char* title, const char* label, VibrationCourse::Ordinate ordinate,
                         std::vector<output::Curve> beside) {
    const bool drive = ordinate == VibrationCourse::frequency_Hz;
    beside.push_back({drive ? "drive" : "fundamental", curve.y(ordinate), Line::stepped});
    section.charts.push_back(course_chart(title, "", label, time, std::move(beside)));
  };
  const auto series = [&](const char* label, VibrationCourse::Ordinate ordinate) {
    return std::vector<output::Curve>{{label, curve.y(ordinate), Line::stepped}};
  };
  const bool resonant = scene.resonant();
  panel("Vibration velocity", "Vibration velocity, amplitude [m/s]",
        VibrationCourse::vibration_m_per_s,
        scene.sensor.vibration ? series("wanted", VibrationCourse::wanted_m_per_s)
                               : std::vector<output::Curve>());
  if (scene.transducer) {
    std::vector<output::Curve> limit;
    if (scene.drive->max_current_amplitude_A) {
      limit.push_back(level("limit", time, *scene.drive->max_current_amplitude_A));
    }
    panel("Current", "Current, amplitude [A]", VibrationCourse::current_A, std::move(limit));
  }
  if (resonant) {
    panel("Frequency", "Frequency [Hz]", VibrationCourse::frequency_Hz,
          series("natural, without contact", VibrationCourse::natural_Hz));
    panel("Phase", "Vibration velocity ahead of the carrier [deg]", VibrationCourse::phase_deg, {});
  } else if (!scene.drive->frequency_profile.empty()) {
    panel("Carrier frequency", "Carrier frequency [Hz]", VibrationCourse::frequency_Hz, {});
  }
  return section;
}

/// The circle that the admittance runs through near the resonance, without friction, and where the
/// run ended.
output::Chart admittance_panel(const scene::Scene& scene,
                               const std::optional<VibrationCourse::OperatingPoint>& point) {
  constexpr int points = 400;
  constexpr double widths = 8.0;  // of the resonance, to either side
  const scene::Plant& plant = scene.plant;
  const double natural_rad_per_s = plant.natural_rad_per_s();
  const double width = plant.damping_N_s_per_m / plant.mass_kg / natural_rad_per_s;
  const double factor = scene.transducer->force_factor_N_per_V;
  output::Curve below{"below the resonance", {}, Line::bridged};
  output::Curve above{"above the resonance", {}, Line::bridged};
  output::Curve operating{"operating point", {}, Line::dots};
  const auto add = [](output::Curve& curve, std::complex<double> admittance_S) {
    curve.x.push_back(admittance_S.real());
    curve.y.push_back(admittance_S.imag());
  };
  for (int k = -points; k <= points; ++k) {
    const double part = static_cast<double>(k) / points;
    const double rate_rad_per_s =
        natural_rad_per_s * std::max(0.01, 1.0 + widths * width * part * std::abs(part));
    const std::complex<double> motional = factor * factor *
                                          std::complex<double>(0.0, rate_rad_per_s) /
                                          configure::dynamic_stiffness(plant, rate_rad_per_s);
    add(k < 0 ? below : above,
        motional + loop::clamped_admittance_S(*scene.transducer, rate_rad_per_s));
  }
  std::string note = fmt::format(
      "Of the transducer without friction, to {:g} widths of the resonance on either side.",
      widths);
  if (point) {
    add(operating, point->admittance_S);
    note += fmt::format(
        " The operating point is a mean of about the last {:g} carrier periods, at {:.6g} Hz.",
        VibrationCourse::operating_periods, point->frequency_Hz);
  }
  return {"Admittance",
          std::move(note),
          {"Conductance [S]"},
          {"Susceptance [S]"},
          {},
          {std::move(below), std::move(above), std::move(operating)}};
}

output::Section close_up(const scene::Scene& scene, const loop::Recording& recording,
                         std::size_t index) {
  const auto column = [&recording](auto value) {
    std::vector<double> values;
    for (const loop::PlantState& state : recording.state) {
      values.push_back(value(state));
    }
    return values;
  };
  const auto displacement = [](const loop::PlantState& state) { return state.displacement_m; };
  const auto velocity = [](const loop::PlantState& state) { return state.velocity_m_per_s; };
  const auto friction = [](const loop::PlantState& state) { return state.friction_force_N; };

  output::Section section{"Start", "The first carrier periods.", {}};
  if (scene.controller) {
    const scene::TargetStep& step = scene.controller->target_friction_ratio[index];
    section.title =
        fmt::format("Step to {:.3g} at {:.6g} ms", step.friction_ratio, step.time_s * 1e3);
    section.text = "The carrier periods around the step.";
  }
  const std::string group = fmt::format("close_up_{}", index);
  const auto panel = [&](const char* title, const char* label, std::vector<double> values) {
    section.charts.push_back(
        {title, "", {time_label}, {label}, recording.time_s, {{title, std::move(values)}}, group});
  };
  panel("Displacement", "Displacement [m]", column(displacement));
  panel("Velocity", "Vibration velocity [m/s]", column(velocity));
  if (scene.friction.largest_limit_N() > 0.0) {
    panel("Friction force", "Friction force [N]", column(friction));
  }
  return section;
}

output::Chart hysteresis_panel(const report::HysteresisLoop& cycle) {
  const auto branch = [](const char* label, const report::Branch& each) {
    return output::Curve{label, each.force_N, Line::bridged, each.displacement_m};
  };
  output::Chart chart{"Friction force against displacement",
                      "One cycle of the contact, at the end of the run.",
                      {"Displacement travelled [m]"},
                      {"Friction force [N]"},
                      {},
                      {branch("sliding forward", cycle.forward)}};
  if (!cycle.backward.force_N.empty()) {
    chart.curves.push_back(branch("sliding back", cycle.backward));
  }
  return chart;
}

output::Chart spectrum_panel(const scene::Scene& scene, const loop::Recording& ending) {
  std::vector<double> velocity;
  for (const loop::PlantState& state : ending.state) {
    velocity.push_back(state.velocity_m_per_s);
  }
  if (!velocity.empty()) {
    velocity.pop_back();  // the sample that begins the next carrier period
  }
  const double interval_s = ending.time_s.size() > 1 ? ending.time_s[1] - ending.time_s[0] : 1.0;
  constexpr double harmonics_shown = 5.0;
  const double highest_Hz = scene.drive ? harmonics_shown * scene.drive->frequency_Hz
                                        : std::numeric_limits<double>::infinity();
  report::Spectrum spectrum = report::amplitude_spectrum(velocity, interval_s, highest_Hz);
  return {
      "Velocity spectrum",
      fmt::format("Amplitude, Hann window, {} samples from the end of the run.", velocity.size()),
      {"Frequency [Hz]"},
      {"Velocity amplitude [m/s]", true},
      std::move(spectrum.frequency_Hz),
      {{"velocity", std::move(spectrum.amplitude)}}};
}

output::Section ending(const scene::Scene& scene, const loop::Recording& recording) {
  constexpr std::size_t samples = 64;
  output::Section section{"End of the run", "", {}};
  // Across the sliding and normal to it the vibration is no part of the displacement travelled.
  if (scene.friction.largest_limit_N() > 0.0 && scene::vibrates_along(scene.friction.law)) {
    section.charts.push_back(
        hysteresis_panel(report::last_cycle(recording, scene.friction.sign_convention, samples)));
  }
  section.charts.push_back(spectrum_panel(scene, recording));
  return section;
}

}  // namespace

output::Page run_page(const scene::Scene& scene, const loop::RunResult& result,
                      const RunFindings& findings) {
  output::Page page{scene.name, lead(scene, result), warnings(scene, result, findings), {}, {}};
  page.scene = scene_file::to_json(scene);
  if (page.scene.contains(nlohmann::ordered_json::json_pointer("/sensor/seed"))) {
    page.seed = scene.sensor.seed;
  }
  if (scene.controller) {
    page.tables.push_back(step_table(scene, findings));
  }
  if (scene.sensor.vibration) {
    page.tables.push_back(vibration_table(findings));
  }
  page.tables.push_back(run_table(scene, result));
  if (result.electrical) {
    page.tables.push_back(electrical_table(*result.electrical));
  }
  if (result.control && !result.control->signals.empty()) {
    page.tables.push_back(signal_table(*result.control));
  }
  if (result.image) {
    page.tables.push_back(image_table(*result.image));
  }
  page.sections.push_back(course(scene, findings.course().curve()));
  if (const VibrationCourse* vibration = findings.vibration()) {
    page.sections.push_back(vibration_section(scene, vibration->curve()));
    if (scene.resonant()) {
      page.sections.back().charts.push_back(admittance_panel(scene, vibration->operating_point()));
    }
  }
  for (std::size_t i = 0; i < findings.close_ups().size(); ++i) {
    page.sections.push_back(close_up(scene, findings.close_ups()[i], i));
  }
  page.sections.push_back(ending(scene, findings.ending()));
  return page;
}

}  // namespace sonoglide::report
