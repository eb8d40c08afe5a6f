#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "host_sim/output/number.hpp"
#include "host_sim/report/run_notes.hpp"
#include "host_sim/report/run_parts.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene_file/echo.hpp"

namespace sonoglide::report {

output::Table step_table(const scene::Scene& scene, const RunFindings& findings) {
  const AmplitudeUnit unit = amplitude_unit(scene);
  const TargetUnit target = target_unit(scene);
  output::Table table{"Target steps",
                      {"From [ms]", held_head(target, "Target"), "Settles in [µs]",
                       held_head(target, "Overshoot"), held_head(target, "Steady error"),
                       held_head(target, "Ripple"), fmt::format("Drive [{}]", unit.name), "Limit"},
                      {}};
  for (const report::StepMetrics& step : findings.steps()) {
    table.rows.push_back(
        {fmt::format("{:.3f}", step.time_s * 1e3), target_figure(target, step.target),
         step.settling_time_s ? fmt::format("{:.1f}", *step.settling_time_s * 1e6) : "never",
         width_figure(target, step.overshoot), error_figure(target, step.steady_error),
         width_figure(target, step.ripple), figure("{:.1f}", step.drive_amplitude_N * unit.per_N),
         limit_text(step)});
  }
  return table;
}

output::Table learnt_friction_table(const loop::FrictionBelief& belief) {
  output::Table table{
      "Friction learnt while driving", {"Figure", "Value", "95 %: from", "95 %: to"}, {}};
  const auto row = [&table](const char* name, const loop::Believed& each, const auto& text) {
    table.rows.push_back({name, text(each.value), text(each.low_95), text(each.high_95)});
  };
  row("Friction force Fc", belief.friction_force,
      [](double force_N) { return output::quantity(force_N, "N"); });
  row("Contact stiffness", belief.contact_stiffness,
      [](double stiffness) { return output::quantity(stiffness, "N/m"); });
  row("Vibration over the nominal one", belief.gain,
      [](double gain) { return fmt::format("{:.4g}", gain); });
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

output::Table run_table(const scene::Scene& scene, const loop::RunResult& result,
                        const RunFindings& findings) {
  const loop::PowerRatios window = loop::power_ratios(scene, result.window);
  output::Table table{"Run", {}, {}};
  const auto row = [&table](const char* name, std::string value) {
    table.rows.push_back({name, std::move(value)});
  };
  if (!scene.load) {
    row("Undriven friction force, window [N]",
        fmt::format("{:.6g}", scene.friction.largest_limit_N() * result.window.undriven_s /
                                  result.window.duration_s));
  }
  if (scene.friction.largest_limit_N() > 0.0) {
    const bool sticks = stick_text(scene, findings).has_value();
    const auto ratio = [&](double of) {
      return sticks ? std::string("none: the contact sticks") : figure("{:.9f}", of);
    };
    row("Friction ratio, whole run", ratio(loop::power_ratios(scene, result.whole).friction_ratio));
    row("Friction ratio, window", ratio(window.friction_ratio));
    row("Power of the pull over that of the friction limit, window",
        figure("{:.6f}", window.pull_ratio));
    row("Power dissipation ratio, window", figure("{:.6f}", window.dissipation_ratio));
    row("Drive input ratio, window", figure("{:.6f}", window.drive_input_ratio));
    row("Change of stored energy, window", figure("{:.6f}", window.stored_change_ratio));
    row("Damping, window", figure("{:.6f}", window.damping_ratio));
    if (scene.load) {
      row("Force on the load, window", figure("{:.6f}", window.load_force_ratio));
      row("Pulled end of the load's spring, window",
          figure("{:.6f}", window.load_spring_pull_ratio));
      row("Damping of the load, window", figure("{:.6f}", window.load_damping_ratio));
      row("Change of the load's energy, window", figure("{:.6f}", window.load_stored_change_ratio));
    }
  }
  if (scene.load) {
    row("Velocity of the load at the end",
        output::quantity(result.final_state.load_velocity_m_per_s, "m/s"));
    row("Displacement of the load at the end",
        output::quantity(result.final_load_displacement_m, "m"));
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

namespace {

std::string lead(const scene::Scene& scene, const loop::RunResult& result) {
  std::string text =
      scene.controller
          ? fmt::format("Closed loop, controller in {}",
                        scene::name_of(scene::arithmetics, scene.controller->arithmetic))
          : std::string("Open loop");
  text += fmt::format(". Friction law: {}. Solver: {}. {} simulated in {}.",
                      scene::name_of(scene.friction.law), scene::name_of(scene.solver.method),
                      output::quantity(result.final_time_s, "s", 6),
                      output::quantity(result.wall_s, "s", 3));
  return text;
}

output::Section figures_section(const scene::Scene& scene, const loop::RunResult& result,
                                const RunFindings& findings) {
  output::Section section{"Figures", "", {}, {run_table(scene, result, findings)}};
  if (result.electrical) {
    section.tables.push_back(electrical_table(*result.electrical));
  }
  if (result.control && !result.control->signals.empty()) {
    section.tables.push_back(signal_table(*result.control));
  }
  if (result.image) {
    section.tables.push_back(image_table(*result.image));
  }
  return section;
}

}  // namespace

output::Page run_page(const configure::Experiment& experiment, const loop::RunResult& result,
                      const RunFindings& findings) {
  const scene::Scene& scene = experiment.plant;
  output::Page page{scene.name, lead(scene, result), run_warnings(scene, result, findings), {}, {}};
  page.scene = scene_file::to_json(experiment.nominal);
  page.notes = run_remarks(scene, result, findings);
  if (page.scene.contains(nlohmann::ordered_json::json_pointer("/sensor/seed"))) {
    page.seed = scene.sensor.seed;
  }
  if (const TextureMeter* texture = findings.texture()) {
    page.tables.push_back(texture_table(scene, *texture));
  } else if (scene.controller) {
    page.tables.push_back(step_table(scene, findings));
  }
  if (result.control && result.control->friction) {
    page.tables.push_back(learnt_friction_table(*result.control->friction));
  }
  if (scene.sensor.vibration && findings.texture() == nullptr) {
    page.tables.push_back(vibration_table(findings));
  }
  if (const TextureMeter* texture = findings.texture()) {
    page.sections.push_back(texture_section(scene, *texture));
  }
  // One carrier period is no course: its ratio stands in the figures, its motion in the sections below.
  if (const Course::Curve& course = findings.course().curve(); course.x().size() > 1) {
    page.sections.push_back(course_section(scene, course));
  }
  if (const VibrationCourse* vibration = findings.vibration()) {
    page.sections.push_back(vibration_section(scene, *vibration));
  }
  for (std::size_t i = 0; i < findings.close_ups().size(); ++i) {
    page.sections.push_back(close_up_section(scene, findings.close_ups()[i], i));
  }
  page.sections.push_back(ending_section(scene, findings.ending()));
  page.sections.push_back(figures_section(scene, result, findings));
  return page;
}

}  // namespace sonoglide::report
