#include "host_sim/studies/stability/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "host_sim/output/gnuplot.hpp"

namespace sonoglide::stability {
namespace {

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

/// The boxes of one verdict, for boxxyerror: neighbours in stiffness are drawn as one.
std::string boxes(const StabilityMaps& maps, const SolverMap& map, Verdict verdict) {
  const double across = half_ratio(maps.grid.contact_stiffness_N_per_m);
  const double along = half_ratio(settings(maps.grid, map));
  // One row that draws nothing: a block must not be empty.
  std::string text = "NaN NaN NaN NaN NaN NaN\n";
  for (auto cell = map.cells.begin(); cell != map.cells.end();) {
    const auto end = std::find_if(cell, map.cells.end(), [&](const MapCell& next) {
      return next.verdict != cell->verdict || next.setting != cell->setting;
    });
    if (cell->verdict == verdict) {
      const double low = std::min(cell->setting / along, cell->setting * along);
      const double high = std::max(cell->setting / along, cell->setting * along);
      text += fmt::format("{0:.6g} {1:.6g} {2:.6g} {3:.6g} {4:.6g} {5:.6g}\n",
                          cell->contact_stiffness_N_per_m, cell->setting,
                          cell->contact_stiffness_N_per_m / across,
                          std::prev(end)->contact_stiffness_N_per_m * across, low, high);
    }
    cell = end;
  }
  return text;
}

std::string data_blocks(const StabilityMaps& maps, const SolverMap& map, std::size_t index) {
  std::string text;
  for (const Shade& shade : shades) {
    text += output::data_block(fmt::format("map_{}_{}", index, static_cast<int>(shade.verdict)),
                               boxes(maps, map, shade.verdict));
  }
  return text;
}

std::string axes(const StabilityMaps& maps, const SolverMap& map) {
  const std::vector<double>& x = maps.grid.contact_stiffness_N_per_m;
  const std::vector<double>& y = settings(maps.grid, map);
  const double across = half_ratio(x);
  const double along = half_ratio(y);
  // The strictest setting is on top in every panel.
  return fmt::format(
      "set title '{}' noenhanced\nset ylabel '{}'\nset xrange [{:.6g}:{:.6g}]\n"
      "set yrange [{:.6g}:{:.6g}]\n",
      map.solver, map.adaptive ? "tolerance [-]" : "steps per carrier period [-]",
      x.front() / across, x.back() * across, y.front() / along, y.back() * along);
}

std::string limit_curve(const StabilityMaps& maps) {
  std::string lines;
  for (const double stiffness : maps.grid.contact_stiffness_N_per_m) {
    lines += fmt::format("{:.6g} {:.6g}\n", stiffness, rk4_limit_steps_per_period(stiffness));
  }
  return output::data_block("limit", lines);
}

std::string panel(const StabilityMaps& maps, const SolverMap& map, std::size_t index) {
  std::string text = axes(maps, map) + "plot ";
  for (const Shade& shade : shades) {
    text += fmt::format(
        "$map_{}_{} using 1:2:3:4:5:6 with boxxyerror fs solid noborder lc rgb "
        "'{}' notitle, ",
        index, static_cast<int>(shade.verdict), shade.colour);
  }
  const bool limited = map.solver == "rk4" || map.solver == "rk4_event";
  return text +
         (limited ? "$limit with lines lw 2 dt 2 lc rgb 'black' notitle\n" : "NaN notitle\n");
}

/// A panel without axes whose curves have nothing but titles.
std::string legend(double height) {
  std::string text = fmt::format(
      "set origin 0,0\nset size 1,{:.4f}\nunset title\nunset border\nunset tics\nunset xlabel\n"
      "unset ylabel\nunset logscale\nset xrange [0:1]\nset yrange [0:1]\nset lmargin at screen "
      "0.02\nset rmargin at screen 0.98\n"
      "set key inside center center horizontal maxrows 2 Left reverse samplen 1.5\nplot ",
      height);
  for (const Shade& shade : shades) {
    text += fmt::format("NaN with boxes fs solid noborder lc rgb '{}' title '{}', ", shade.colour,
                        shade.text);
  }
  return text + "NaN with lines lw 2 dt 2 lc rgb 'black' title 'h = 2.785 Fc/(Kt |V|max)'\n";
}

}  // namespace

std::string map_picture(const StabilityMaps& maps, std::string_view precision) {
  std::vector<const SolverMap*> series;
  for (const SolverMap& map : maps.maps) {
    if (map.precision == precision) {
      series.push_back(&map);
    }
  }
  const auto rows = static_cast<int>((series.size() + panel_columns - 1) / panel_columns);
  const int height_px = rows * panel_height_px + legend_height_px;
  const double legend_height = static_cast<double>(legend_height_px) / height_px;
  const double panel_height = (1.0 - legend_height) / rows;
  std::string script = limit_curve(maps);
  for (std::size_t i = 0; i < series.size(); ++i) {
    script += data_blocks(maps, *series[i], i);
  }
  script +=
      "set multiplot\nset logscale xy\nset format '10^{%T}'\nset xlabel 'contact stiffness [N/m]'\n"
      "set tics out nomirror\nunset mxtics\nunset mytics\n";
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto row = static_cast<int>(i) / panel_columns;
    const auto column = static_cast<int>(i) % panel_columns;
    script += fmt::format("set origin {:.4f},{:.4f}\nset size {:.4f},{:.4f}\n",
                          static_cast<double>(column) / panel_columns,
                          1.0 - (row + 1) * panel_height, 1.0 / panel_columns, panel_height);
    script += panel(maps, *series[i], i);
  }
  script += legend(legend_height) + "unset multiplot\n";
  return output::draw_svg(script, panel_columns * panel_width_px, height_px);
}

}  // namespace sonoglide::stability
