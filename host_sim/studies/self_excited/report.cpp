#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "host_sim/loop/steady/requirement.hpp"
#include "host_sim/output/chart.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/output/program.hpp"
#include "host_sim/report/self_excitation.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/studies/self_excited/study.hpp"

namespace sonoglide::self_excited {
namespace {

using steady::Fate;

struct Shade {
  Fate fate;
  const char* colour;  ///< apart for every kind of colour vision: Okabe and Ito (2008)
  const char* text;
};

constexpr std::array<Shade, 4> shades = {{
    {Fate::dies_out, "#56B4E9", "steady sliding is stable"},
    {Fate::grows, "#D55E00", "it is unstable"},
    {Fate::stays, "#F0E442", "nothing damps it"},
    {Fate::unknown, "#999999", "no steady motion found"},
}};

const char* words(Fate fate) {
  return std::find_if(shades.begin(), shades.end(),
                      [&](const Shade& shade) { return shade.fate == fate; })
      ->text;
}

std::string csv(const Study& study) {
  std::string text =
      "sliding_velocity_m_per_s,drive_force_N,vibration_velocity_m_per_s,multiplier,fate,"
      "averaged_multiplier,averaged_fate\n";
  for (const steady::SteadySliding& each : study.map) {
    text += fmt::format("{},{},{},{}\n",
                        output::csv_cells({each.sliding_m_per_s, each.drive_force_N,
                                           each.vibration_m_per_s, each.multiplier}),
                        name(each.fate()), output::csv_number(each.averaged_multiplier),
                        name(each.averaged_fate()));
  }
  return text;
}

double per_N(const Study& study) {
  return 1.0 / steady::force_N(study.task.scene, 1.0);
}

nlohmann::ordered_json windows_json(const Study& study,
                                    const std::vector<steady::DriveWindow>& windows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const steady::DriveWindow& each : windows) {
    all.push_back({{"from_N", each.low_N},
                   {"to_N", each.high_N},
                   {"from_m_per_s", each.low_N * per_N(study)},
                   {"to_m_per_s", each.high_N * per_N(study)},
                   {"fate", name(each.fate)}});
  }
  return all;
}

std::string json(const Study& study) {
  const steady::SteadySliding& undriven = study.at_own_speed.front();
  const nlohmann::ordered_json all = {
      {"program", output::program_json()},
      {"sliding_velocity_m_per_s", study.task.sliding_m_per_s},
      {"friction_falls", study.falls},
      {"undriven",
       {{"multiplier", output::json_number(undriven.multiplier)}, {"fate", name(undriven.fate())}}},
      {"windows", windows_json(study, study.windows)},
      {"averaged_windows", windows_json(study, study.averaged_windows)},
      {"scene", scene_file::to_json(study.task.scene)}};
  return all.dump(2) + '\n';
}

/// Halfway to the neighbours, and no farther than the ends.
std::vector<output::Span> cells_about(const std::vector<double>& places) {
  std::vector<output::Span> cells;
  for (std::size_t i = 0; i < places.size(); ++i) {
    cells.push_back({i == 0 ? places[i] : 0.5 * (places[i - 1] + places[i]),
                     i + 1 == places.size() ? places[i] : 0.5 * (places[i] + places[i + 1])});
  }
  return cells;
}

output::Chart map_chart(const Study& study) {
  output::Chart chart{
      "Steady sliding over belt speed and drive",   "", {"Sliding velocity [m/s]", true},
      {"Vibration velocity without contact [m/s]"}, {}, {}};
  const std::vector<output::Span> speeds = cells_about(study.speeds_m_per_s);
  std::vector<double> vibrations_m_per_s = study.forces_N;
  for (double& each : vibrations_m_per_s) {
    each *= per_N(study);
  }
  const std::vector<output::Span> drives = cells_about(vibrations_m_per_s);
  for (const Shade& shade : shades) {
    output::Tiles tiles{{}, shade.colour};
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      for (std::size_t j = 0; j < drives.size(); ++j) {
        if (study.at(i, j).fate() == shade.fate) {
          const bool joins = j > 0 && study.at(i, j - 1).fate() == shade.fate;
          if (joins) {
            tiles.all.back().y.high = drives[j].high;
          } else {
            tiles.all.push_back({speeds[i], drives[j]});
          }
        }
      }
    }
    tiles.label = tiles.all.empty() ? "" : shade.text;
    chart.tiles.push_back(std::move(tiles));
  }
  output::Curve edges{"edges by averaging", {}, output::Line::dots};
  for (std::size_t i = 0; i < study.speeds_m_per_s.size(); ++i) {
    for (std::size_t j = 1; j < study.forces_N.size(); ++j) {
      if (study.at(i, j).averaged_fate() != study.at(i, j - 1).averaged_fate()) {
        edges.x.push_back(study.speeds_m_per_s[i]);
        edges.y.push_back(drives[j].low);
      }
    }
  }
  edges.pen.colour = "#000000";
  if (!edges.x.empty()) {
    chart.curves.push_back(std::move(edges));
  }
  chart.curves.push_back(
      {"the scene's speed", {1.0}, output::Line::full_height, {study.task.sliding_m_per_s}});
  return chart;
}

double growth_per_s(const Study& study, double multiplier) {
  return std::log(multiplier) * study.task.scene.drive->frequency_Hz;
}

output::Chart growth_chart(const Study& study) {
  output::Chart chart{"Growth of a small deviation at the scene's speed",
                      "Above 0 it grows. The steps between the points are those of the map.",
                      {"Force amplitude [N]"},
                      {"Rate of growth [1/s]"},
                      study.forces_N,
                      {{"steady motion", {}}, {"by averaging", {}}}};
  for (const steady::SteadySliding& each : study.at_own_speed) {
    chart.curves[0].y.push_back(growth_per_s(study, each.multiplier));
    chart.curves[1].y.push_back(growth_per_s(study, each.averaged_multiplier));
  }
  chart.y_axis.has_zero = true;
  return chart;
}

output::Table windows_table(const Study& study, const char* title,
                            const std::vector<steady::DriveWindow>& windows) {
  output::Table table{title, {"From", "To", "Vibration from", "to", "Steady sliding"}, {}};
  for (const steady::DriveWindow& each : windows) {
    table.rows.push_back({output::quantity(each.low_N, "N"), output::quantity(each.high_N, "N"),
                          output::quantity(each.low_N * per_N(study), "m/s"),
                          output::quantity(each.high_N * per_N(study), "m/s"), words(each.fate)});
  }
  return table;
}

std::string undriven_text(const Study& study) {
  const steady::SteadySliding& undriven = study.at_own_speed.front();
  std::string text =
      fmt::format("Undriven at {}: {}", output::quantity(study.task.sliding_m_per_s, "m/s"),
                  words(undriven.fate()));
  if (std::isfinite(undriven.multiplier)) {
    text +=
        fmt::format(", largest Floquet multiplier of a carrier period {:.9g}", undriven.multiplier);
  }
  text += '.';
  if (undriven.averaged_multiplier > steady::largest_growth) {
    text += fmt::format(
        " The friction feeds a deviation by more than {:g} in a carrier period: where it does, no steady "
        "motion is looked for. A heavier mass or a faster drive changes that.",
        steady::largest_growth);
  }
  if (!study.falls) {
    text +=
        " The friction of this contact never falls with the velocity: undriven it excites nothing.";
  }
  return text;
}

output::Page page(const Study& study) {
  const scene::Scene& scene = study.task.scene;
  output::Page page{
      fmt::format("Self-excited oscillation of {}", scene.name),
      fmt::format("Does steady sliding stay steady, and which drives quench an oscillation that it "
                  "excites? {} contact, drive of {} with up to {}. {}",
                  scene::name_of(scene.friction.law),
                  output::quantity(scene.drive->frequency_Hz, "Hz"),
                  output::quantity(study.task.most_N, "N"), undriven_text(study)),
      {},
      {},
      {}};
  page.scene = scene_file::to_json(scene);
  output::Section map;
  map.title = "Belt speed and drive";
  map.text =
      "A colour says what becomes of a small deviation from the steady motion: its largest Floquet "
      "multiplier over a carrier period is below 1, above it, or 1 within 1e-6. The dots are edges by "
      "averaging: the mean friction over a sinusoidal vibration as a force that changes with the "
      "sliding velocity, on a natural mode that is slow.";
  map.charts = {map_chart(study)};
  output::Section own;
  own.title = "Windows of the drive at the scene's speed";
  own.text = fmt::format(
      "In a stable window the drive quenches the oscillation; in another it excites it, also where "
      "less drive would not. {} self_excited.csv has the map, in steps of {}.",
      report::missed_windows_text(study.task.most_N), output::quantity(study.forces_N[1], "N"));
  own.charts = {growth_chart(study)};
  own.tables = {windows_table(study, "By the steady motion", study.windows),
                windows_table(study, "By averaging", study.averaged_windows)};
  page.sections = {std::move(map), std::move(own)};
  return page;
}

std::string text(const Study& study) {
  std::string lines = undriven_text(study) + '\n';
  for (const steady::DriveWindow& each : study.windows) {
    lines += fmt::format("drive {:>9} to {:>9}, vibration {:>10} to {:>10}: {}\n",
                         output::quantity(each.low_N, "N"), output::quantity(each.high_N, "N"),
                         output::quantity(each.low_N * per_N(study), "m/s"),
                         output::quantity(each.high_N * per_N(study), "m/s"), words(each.fate));
  }
  return lines + report::missed_windows_text(study.task.most_N) + '\n';
}

}  // namespace

output::StudyReport report(const Study& study) {
  return {{{"report.html", output::to_html(page(study))},
           {"self_excited.csv", csv(study)},
           {"self_excited.json", json(study)},
           {"self_excited.svg", output::print({{map_chart(study)}, 800, 600})}},
          text(study)};
}

}  // namespace sonoglide::self_excited
