#include "host_sim/studies/design/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host_sim/output/number.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/echo.hpp"

namespace sonoglide::design {
namespace {

std::string drive_line(const steady::Requirement& point) {
  const steady::SteadyMotion& motion = point.motion;
  return fmt::format("{:>10} {:>6.4g} {:>9} {:>10} {:>9} {:>9} {:>9} {:>9}  {}\n",
                     output::quantity(point.sliding_m_per_s, "m/s"), point.ratio,
                     output::quantity(motion.drive_force_N, "N"),
                     output::quantity(motion.velocity_amplitude_m_per_s, "m/s"),
                     output::quantity(motion.displacement_amplitude_m, "m"),
                     output::quantity(motion.drive_power_W, "W"),
                     output::quantity(motion.friction_power_W, "W"),
                     output::quantity(motion.undriven_friction_power_W, "W"), name(point.limit));
}

std::string sensitivity_lines(const std::vector<DesignPoint>& points) {
  if (points.empty()) {
    return {};
  }
  std::string lines = fmt::format("\nd ln ratio / d ln p\n{:>10} {:>6}", "sliding", "ratio");
  for (const Sensitivity& each : points.front().sensitivities) {
    lines += fmt::format(" {:>7}", each.parameter.symbol);
  }
  for (const DesignPoint& point : points) {
    lines +=
        fmt::format("\n{:>10} {:>6.4g}", output::quantity(point.requirement.sliding_m_per_s, "m/s"),
                    point.requirement.ratio);
    for (const Sensitivity& each : point.sensitivities) {
      lines += fmt::format(" {:>7}", output::formatted(each.logarithmic, "{:.3f}"));
    }
  }
  return lines + '\n';
}

std::string text(const DesignStudy& study) {
  std::string lines =
      fmt::format("{:>10} {:>6} {:>9} {:>10} {:>9} {:>9} {:>9} {:>9}  {}\n", "sliding", "ratio",
                  "force", "vibration", "amplitude", "drive", "friction", "undriven", "limit");
  for (const DesignPoint& point : study.points) {
    lines += drive_line(point.requirement);
  }
  lines += sensitivity_lines(moving_points(study)) + '\n';
  for (const std::string& each : shortfalls(study)) {
    lines += fmt::format("UNREACHABLE: {}\n", each);
  }
  for (const Advice& each : advice(study)) {
    lines += fmt::format("{}: {}\n", each.topic, each.sentence);
  }
  return lines;
}

}  // namespace

output::StudyReport report(const DesignStudy& study) {
  return {{{"report.html", output::to_html(page(study))},
           {"design.json", to_json(study).dump(2) + '\n'},
           {"design.csv", requirements_csv(study)},
           {"detuning.csv", detuning_csv(study)}},
          text(study)};
}

namespace {

std::string speeds_text(const SpeedRange& speeds) {
  const std::string slowest = output::quantity(speeds.slowest_m_per_s, "m/s");
  return speeds.slowest_m_per_s == speeds.fastest_m_per_s
             ? slowest
             : fmt::format("{} to {}", slowest, output::quantity(speeds.fastest_m_per_s, "m/s"));
}

std::string lead(const DesignStudy& study) {
  const scene::Scene& scene = study.task.scene;
  return fmt::format(
      "What the drive of {} must do to hold a friction ratio: {} contact, drive of {} with up to "
      "{}, sliding at {}. Figures are those of the simulated plant on its steady orbit.",
      scene.name, scene::name_of(scene.friction.law),
      output::quantity(scene.drive->frequency_Hz, "Hz"),
      fmt::format("{:.4g} N", scene.max_drive_force_N()), speeds_text(study.task.speeds));
}

output::Table advice_table(const DesignStudy& study) {
  output::Table table{"What to do", {}, {}};
  for (const Advice& each : advice(study)) {
    table.rows.push_back({each.topic, each.sentence});
  }
  return table;
}

output::Table drive_table(const DesignStudy& study) {
  output::Table table{"",
                      {"Sliding", "Ratio", "Force", "Velocity amplitude", "Amplitude", "Limit",
                       "Ratio within reach", "Closed form", "It misses by"},
                      {}};
  for (const DesignPoint& point : study.points) {
    const steady::Requirement& each = point.requirement;
    table.rows.push_back({output::quantity(each.sliding_m_per_s, "m/s"),
                          output::formatted(each.ratio, "{:.4g}"),
                          output::quantity(each.motion.drive_force_N, "N"),
                          output::quantity(each.motion.velocity_amplitude_m_per_s, "m/s"),
                          output::quantity(each.motion.displacement_amplitude_m, "m"),
                          name(each.limit), output::formatted(each.reachable_ratio, "{:.4g}"),
                          output::quantity(each.closed_form_force_N, "N"),
                          output::formatted(each.closed_form_error, "{:.4g}")});
  }
  return table;
}

output::Table power_table(const std::vector<DesignPoint>& points) {
  output::Table table{"",
                      {"Sliding", "Ratio", "Drive", "Friction", "Friction, undriven", "Damping",
                       "Fe v/2, to and fro"},
                      {}};
  for (const DesignPoint& point : points) {
    const steady::SteadyMotion& motion = point.requirement.motion;
    table.rows.push_back({output::quantity(point.requirement.sliding_m_per_s, "m/s"),
                          output::formatted(point.requirement.ratio, "{:.4g}"),
                          output::quantity(motion.drive_power_W, "W"),
                          output::quantity(motion.friction_power_W, "W"),
                          output::quantity(motion.undriven_friction_power_W, "W"),
                          output::quantity(motion.damping_power_W, "W"),
                          output::quantity(motion.apparent_power_W, "W")});
  }
  return table;
}

output::Table electrical_table(const std::vector<DesignPoint>& points) {
  output::Table table{
      "Transducer",
      {"Sliding", "Ratio", "Voltage", "Current", "Active", "Reactive", "Apparent", "Power factor"},
      {}};
  for (const DesignPoint& point : points) {
    if (const auto& figures = point.requirement.motion.electrical) {
      table.rows.push_back({output::quantity(point.requirement.sliding_m_per_s, "m/s"),
                            output::formatted(point.requirement.ratio, "{:.4g}"),
                            output::quantity(figures->voltage_peak_V, "V"),
                            output::quantity(figures->current_peak_A, "A"),
                            output::quantity(figures->active_power_W, "W"),
                            output::quantity(figures->reactive_power_var, "var"),
                            output::quantity(figures->apparent_power_VA, "VA"),
                            output::formatted(figures->power_factor, "{:.4g}")});
    }
  }
  return table;
}

output::Section drive_section(const DesignStudy& study, const std::vector<DesignPoint>& moving) {
  output::Section section;
  section.title = "Required drive";
  section.text =
      "Amplitudes are half of peak to peak. \"Closed form\" is the force that the inverse of the "
      "friction-ratio map gives for a sinusoidal vibration; \"it misses by\" is the simulated ratio "
      "under this force, less the ratio asked for. Powers are means over a carrier period: what the "
      "drive puts into the motion, what the contact dissipates with and without vibration, and "
      "what the drive and the mass exchange. design.csv has the curves.";
  section.tables = {drive_table(study)};
  if (!moving.empty()) {
    section.tables.push_back(power_table(moving));
    if (study.task.scene.transducer) {
      section.tables.push_back(electrical_table(moving));
    }
  }
  section.charts = requirement_charts(study);
  return section;
}

output::Table sensitivity_table(const std::vector<DesignPoint>& points, const char* title,
                                std::string (*cell)(const Sensitivity&)) {
  output::Table table{title, {"Sliding", "Ratio"}, {}};
  for (const Sensitivity& each : points.front().sensitivities) {
    table.header.emplace_back(each.parameter.symbol);
  }
  for (const DesignPoint& point : points) {
    std::vector<std::string> row = {output::quantity(point.requirement.sliding_m_per_s, "m/s"),
                                    output::formatted(point.requirement.ratio, "{:.4g}")};
    for (const Sensitivity& each : point.sensitivities) {
      row.push_back(cell(each));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

output::Section sensitivity_section(const DesignStudy& study,
                                    const std::vector<DesignPoint>& points) {
  output::Section section;
  section.title = "What the ratio depends on";
  section.text =
      "One parameter changes. The others and the drive's force stay as they are; so does the normal "
      "force where the mass changes. The derivatives are differences of simulated ratios.";
  section.tables = {sensitivity_table(points, "d ln ratio / d ln parameter",
                                      [](const Sensitivity& each) {
                                        return output::formatted(each.logarithmic, "{:.3f}");
                                      }),
                    sensitivity_table(points, "Change of the ratio by 1 % more or less, the larger",
                                      [](const Sensitivity& each) {
                                        return output::formatted(each.largest_change(), "{:.5f}");
                                      })};
  if (!study.detunings.empty()) {
    section.charts = {sensitivity_chart(study)};
  }
  return section;
}

std::string text(const std::optional<TuningBand>& band, double drive_Hz) {
  if (!band) {
    return "-";
  }
  const auto edge = [&](double tuning) {
    return fmt::format("{:.3g} ({})", tuning, output::quantity(std::sqrt(tuning) * drive_Hz, "Hz"));
  };
  return fmt::format("{} to {}", edge(band->low), edge(band->high));
}

output::Section resonance_section(const DesignStudy& study) {
  output::Section section;
  section.title = "Resonance: what it gives and what it costs";
  section.text = fmt::format(
      "The same mass, contact and drive on another spring, at the fastest sliding. The scene has "
      "Ks/(m ω²) = {:.4g}. Towards 1 the force falls with |1 - Ks/(m ω²)|, and an error in the "
      "spring counts for more. Too sensitive: 1 % of Ks changes the ratio by more than the scene's "
      "settling band of {:g}. In brackets the natural frequency. Reach is looked for from {:g} to "
      "{:g}. detuning.csv has the curves.",
      study.tuning, study.task.scene.run.settling_band, smallest_tuning, largest_tuning);
  output::Table table{
      "",
      {"Ratio", "Within the drive's reach", "Too sensitive", "Force at the lower edge of that"},
      {}};
  const double drive_Hz = study.task.scene.drive->frequency_Hz;
  for (const Detuning& each : study.detunings) {
    table.rows.push_back({output::formatted(each.ratio, "{:.4g}"), text(each.reachable, drive_Hz),
                          text(each.sensitive, drive_Hz),
                          output::quantity(each.force_at_sensitive_low_N, "N")});
  }
  section.tables = {table};
  section.charts = detuning_charts(study);
  return section;
}

}  // namespace

output::Page page(const DesignStudy& study) {
  const std::vector<DesignPoint> points = moving_points(study);
  output::Page page{fmt::format("Design of {}", study.task.scene.name),
                    lead(study),
                    shortfalls(study),
                    {advice_table(study)},
                    {drive_section(study, points)}};
  page.scene = scene_file::to_json(study.task.scene);
  if (!points.empty()) {
    page.sections.push_back(sensitivity_section(study, points));
  }
  if (study.natural_mode) {
    page.sections.push_back(natural_mode_section(study, *study.natural_mode));
  }
  if (!study.self_excitation.empty()) {
    page.sections.push_back(self_excitation_section(study));
  }
  if (!study.detunings.empty()) {
    page.sections.push_back(resonance_section(study));
  }
  return page;
}

}  // namespace sonoglide::design
