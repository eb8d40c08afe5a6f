#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "host_sim/output/chart.hpp"
#include "host_sim/studies/stability/random_scene.hpp"
#include "host_sim/studies/stability/study.hpp"

namespace sonoglide::stability {
namespace {

using Row = std::vector<std::string>;

std::uint64_t count(const ExtremeRow& row, Verdict verdict) {
  return row.count[static_cast<std::size_t>(verdict)];
}

std::string lead(const StabilityStudy& study) {
  return fmt::format(
      "Every solver over step or tolerance and contact stiffness, and over {} random scenes of "
      "{} carrier periods that span what anybody may ask for. A result is either good, or the "
      "solver declines it and says why, or it is wrong and nothing in it shows: the last kind is "
      "what this page counts.",
      study.extremes.scenes, random_scene_periods);
}

output::Table verdicts() {
  return {"What each verdict means",
          {"Verdict", "Meaning", "What to do"},
          {{"accurate",
            fmt::format("The friction ratio of the whole run is within {:g} of the reference.",
                        accurate_error),
            "Use it."},
           {"bounded but wrong",
            "Finite and |F| <= Fc, yet the friction ratio is off. Nothing in the result shows it.",
            "Shorten the step or tighten the tolerance until the result stops changing, or use "
            "event_taylor."},
           {"|F| > Fc, not reported; not finite, not reported",
            "The result breaks the friction law, or holds no number, and was handed over as good.",
            "A fault of the solver: please report the scene."},
           {"declined: |F| > Fc, step too long for the contact or the oscillator",
            "The solver found the friction force beyond its limit, or saw that it was about to "
            "pass it, and stopped.",
            "Shorten the step to 2.785 Fc/(Kt |V|) or below, or use event_taylor."},
           {"declined: blown up", "The solver found a state that is no number and stopped.",
            "Shorten the step, or use event_taylor; in float32, use float64."},
           {"declined: too many steps",
            "The motion holds a rate so far above the carrier that the step budget of a period "
            "ran out.",
            "Raise the drive frequency or lower the stiffness, or accept the cost of resolving "
            "it."}}};
}

std::string solver_text(const ExtremeRow& row) {
  return fmt::format("{}, {}", row.solver, row.precision);
}

Row extreme_cells(const ExtremeRow& row) {
  return {solver_text(row),
          fmt::format("{:g}", row.setting),
          fmt::format("{}", count(row, Verdict::good)),
          fmt::format("{}", count(row, Verdict::silent_not_finite)),
          fmt::format("{}", count(row, Verdict::silent_friction_bound)),
          fmt::format("{}", count(row, Verdict::wrong)),
          fmt::format("{}", count(row, Verdict::declined_friction_bound) +
                                count(row, Verdict::declined_step_too_long)),
          fmt::format("{}", count(row, Verdict::declined_not_finite)),
          fmt::format("{}", count(row, Verdict::declined_too_many_steps)),
          fmt::format("{}", count(row, Verdict::unsupported))};
}

output::Table extreme_table(const Extremes& extremes) {
  output::Table table{
      fmt::format("Extreme cases: {} random scenes", extremes.scenes),
      {"Solver", "Setting", "Good", "Silent: not finite", "Silent: |F| > Fc", "Silent: energy",
       "Declined: contact", "Declined: blown up", "Declined: steps", "Law refused"},
      {}};
  for (const ExtremeRow& row : extremes.rows) {
    table.rows.push_back(extreme_cells(row));
  }
  return table;
}

output::Table residual_table(const Extremes& extremes) {
  output::Table table{"Balance residual of what was handed over as good",
                      {"Solver", "Median", "90 %", "99 %", "99.9 %", "Largest"},
                      {}};
  for (const ExtremeRow& row : extremes.rows) {
    Row cells = {solver_text(row)};
    for (const double residual : row.residual) {
      cells.push_back(fmt::format("{:.1e}", residual));
    }
    table.rows.push_back(cells);
  }
  return table;
}

std::string map_text(const StabilityMaps& maps) {
  return fmt::format(
      "The paper's Table 1 at 384 N, sliding at half the peak vibration velocity, {} carrier "
      "periods from rest, compared with event_taylor of order 16 at tolerance 1e-12 (which order "
      "12 at 1e-13 confirms within {:.1e}). The dashed line is where classical Runge–Kutta "
      "becomes unstable in a full slide.",
      maps.grid.periods, maps.reference_difference);
}

std::string extremes_text() {
  return fmt::format(
      "The balance residual compares the change of stored energy with the works of drive, damper "
      "and contact, relative to the largest energy that passed through the run: the sum over the "
      "steps of the magnitude of one of those works, or the largest energy stored. Good means at "
      "most {:g} in float64 and {:g} in float32. A solver may take {} steps per "
      "period. extremes_worst.csv lists the worst scenes of each solver with all their numbers.",
      allowed_residual_float64, allowed_residual_float32, extreme_step_limit);
}

constexpr int panel_columns = 3;
constexpr int panel_width_px = 380;
constexpr int panel_height_px = 300;
constexpr int legend_height_px = 90;

struct Shade {
  Verdict verdict;
  const char* colour;  ///< apart for every kind of colour vision: Okabe and Ito (2008)
  const char* text;
};

/// Orange, pink and black for what goes unnoticed; blue, yellow and grey for what is reported.
constexpr std::array<Shade, 8> shades = {{
    {Verdict::good, "#009E73", "accurate"},
    {Verdict::wrong, "#D55E00", "bounded but wrong, not reported"},
    {Verdict::silent_friction_bound, "#CC79A7", "|F| > Fc, not reported"},
    {Verdict::silent_not_finite, "#000000", "not finite, not reported"},
    {Verdict::declined_friction_bound, "#56B4E9", "declined: |F| > Fc"},
    {Verdict::declined_step_too_long, "#F0E442", "declined: step too long"},
    {Verdict::declined_not_finite, "#0072B2", "declined: blown up"},
    {Verdict::declined_too_many_steps, "#999999", "declined: too many steps"},
}};

/// Half the ratio of neighbouring values: how far a cell reaches to either side of its own.
double half_ratio(const std::vector<double>& values) {
  return values.size() < 2 ? 1.2 : std::sqrt(values[1] / values[0]);
}

const std::vector<double>& settings(const MapGrid& grid, const SolverMap& map) {
  return map.adaptive ? grid.tolerance : grid.steps_per_period;
}

/// The boxes of one verdict: neighbours in stiffness are drawn as one.
output::Tiles boxes(const StabilityMaps& maps, const SolverMap& map, const Shade& shade) {
  const double across = half_ratio(maps.grid.contact_stiffness_N_per_m);
  const double along = half_ratio(settings(maps.grid, map));
  output::Tiles boxes{{}, shade.colour};
  for (auto cell = map.cells.begin(); cell != map.cells.end();) {
    const auto end = std::find_if(cell, map.cells.end(), [&](const MapCell& next) {
      return next.verdict != cell->verdict || next.setting != cell->setting;
    });
    if (cell->verdict == shade.verdict) {
      const auto [low, high] = std::minmax({cell->setting / along, cell->setting * along});
      boxes.all.push_back({{cell->contact_stiffness_N_per_m / across,
                            std::prev(end)->contact_stiffness_N_per_m * across},
                           {low, high}});
    }
    cell = end;
  }
  return boxes;
}

const output::Pen limit_pen = {"#000000", 2.0, 2};
constexpr const char* limit_text = "h = 2.785 Fc/(Kt |V|max)";

/// Where classical Runge–Kutta becomes unstable.
output::Curve limit_curve(const StabilityMaps& maps) {
  output::Curve curve{"", {}, output::Line::joined, maps.grid.contact_stiffness_N_per_m, limit_pen};
  for (const double stiffness : curve.x) {
    curve.y.push_back(rk4_limit_steps_per_period(stiffness));
  }
  return curve;
}

output::Chart panel(const StabilityMaps& maps, const SolverMap& map) {
  const std::vector<double>& x = maps.grid.contact_stiffness_N_per_m;
  const std::vector<double>& y = settings(maps.grid, map);
  const double across = half_ratio(x);
  const double along = half_ratio(y);
  // The strictest setting is on top in every panel.
  output::Chart chart{
      std::string(map.solver),
      "",
      {"contact stiffness [N/m]", true, {x.front() / across, x.back() * across}, "10^{%T}"},
      {map.adaptive ? "tolerance [-]" : "steps per carrier period [-]",
       true,
       {y.front() / along, y.back() * along},
       "10^{%T}"},
      {},
      {}};
  for (const Shade& shade : shades) {
    chart.tiles.push_back(boxes(maps, map, shade));
  }
  if (map.solver == "rk4" || map.solver == "rk4_event") {
    chart.curves.push_back(limit_curve(maps));
  }
  chart.verbatim = true;
  return chart;
}

std::vector<const SolverMap*> of_precision(const StabilityMaps& maps, std::string_view precision) {
  std::vector<const SolverMap*> shown;
  for (const SolverMap& map : maps.maps) {
    if (map.precision == precision) {
      shown.push_back(&map);
    }
  }
  return shown;
}

/// On the page each panel has a key of its own, of what is in it.
output::Section map_section(const StabilityMaps& maps, std::string_view precision) {
  output::Section section{fmt::format("Maps in {}", precision), map_text(maps), {}};
  for (const SolverMap* map : of_precision(maps, precision)) {
    output::Chart chart = panel(maps, *map);
    for (std::size_t i = 0; i < shades.size(); ++i) {
      chart.tiles[i].label = chart.tiles[i].all.empty() ? "" : shades[i].text;
    }
    for (output::Curve& each : chart.curves) {
      each.label = limit_text;
    }
    chart.group = "stiffness";
    section.charts.push_back(std::move(chart));
  }
  return section;
}

/// A panel without axes whose curves have nothing but titles.
output::Chart legend(double height) {
  output::Chart chart{"", "", {"", false, {0.0, 1.0}}, {"", false, {0.0, 1.0}}, {}, {}};
  for (const Shade& shade : shades) {
    chart.tiles.push_back({{}, shade.colour, shade.text});
  }
  chart.curves.push_back({limit_text, {}, output::Line::joined, {}, limit_pen});
  chart.place = {0.0, 0.0, 1.0, height};
  chart.look =
      "unset border\nunset tics\nset lmargin at screen 0.02\nset rmargin at screen 0.98\n"
      "set key inside center center horizontal maxrows 2 Left reverse samplen 1.5\n";
  return chart;
}

}  // namespace

output::Sheet map_sheet(const StabilityMaps& maps, std::string_view precision) {
  const std::vector<const SolverMap*> shown = of_precision(maps, precision);
  const auto rows = static_cast<int>((shown.size() + panel_columns - 1) / panel_columns);
  const int height_px = rows * panel_height_px + legend_height_px;
  const double legend_height = static_cast<double>(legend_height_px) / height_px;
  const double panel_height = (1.0 - legend_height) / rows;
  output::Sheet sheet{{},
                      panel_columns * panel_width_px,
                      height_px,
                      panel_columns,
                      "set tics out nomirror\nunset mxtics\nunset mytics\n"};
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto row = static_cast<int>(i) / panel_columns;
    const auto column = static_cast<int>(i) % panel_columns;
    output::Chart& chart = sheet.charts.emplace_back(panel(maps, *shown[i]));
    chart.place = {static_cast<double>(column) / panel_columns, 1.0 - (row + 1) * panel_height,
                   1.0 / panel_columns, panel_height};
  }
  sheet.charts.push_back(legend(legend_height));
  return sheet;
}

output::Page study_page(const StabilityStudy& study) {
  output::Page page;
  page.title = "Where each solver can be trusted";
  page.lead = lead(study);
  page.tables = {verdicts()};
  page.sections = {map_section(study.maps, "float64"),
                   map_section(study.maps, "float32"),
                   {"Extreme cases",
                    extremes_text(),
                    {},
                    {extreme_table(study.extremes), residual_table(study.extremes)}}};
  return page;
}

}  // namespace sonoglide::stability
