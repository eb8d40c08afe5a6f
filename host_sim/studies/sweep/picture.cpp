#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/sweep/report.hpp"
#include "host_sim/studies/sweep/subject.hpp"

namespace sonoglide::sweep {
namespace {

/// Viridis at nine places. Source: Smith and van der Walt, the default colour map of Matplotlib 2.
constexpr const char* palette =
    "set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', "
    "5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725')\n";
constexpr const char* grey = "#b8b8b8";

struct Cell {
  std::size_t index;  ///< along the axis
  double low;
  double high;
};

double between(const Axis& axis, double a, double b) {
  return axis.logarithmic ? std::copysign(std::sqrt(std::abs(a)) * std::sqrt(std::abs(b)), a)
                          : 0.5 * a + 0.5 * b;
}

/// As far beyond the end as the neighbour's edge is before it.
double mirrored(const Axis& axis, double end, double edge) {
  return axis.logarithmic ? end * (end / edge) : end + (end - edge);
}

/// Cells that meet half way between the values picked.
std::vector<Cell> cells(const Axis& axis) {
  const std::size_t stride = (axis.count - 1) / most_cells_along + 1;
  std::vector<std::size_t> picked;
  for (std::size_t index = 0; index < axis.count; index += stride) {
    picked.push_back(index);
  }
  std::vector<double> edges(picked.size() + 1);
  for (std::size_t i = 1; i < picked.size(); ++i) {
    edges[i] = between(axis, axis.position(picked[i - 1]), axis.position(picked[i]));
  }
  edges.front() = mirrored(axis, axis.position(picked.front()), edges[1]);
  edges.back() = mirrored(axis, axis.position(picked.back()), edges[picked.size() - 1]);
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < picked.size(); ++i) {
    cells.push_back(
        {picked[i], std::min(edges[i], edges[i + 1]), std::max(edges[i], edges[i + 1])});
  }
  return cells;
}

std::string range_command(const std::vector<Cell>& cells, char letter) {
  return fmt::format("set {}range [{}:{}]\n", letter, std::min(cells.front().low, cells.back().low),
                     std::max(cells.front().high, cells.back().high));
}

/// A gnuplot script: one cell for each point in the colour of the sweep's subject(), grey where
/// that is not defined. Other axes stay at their first value.
/// @param upward, rightward  axes with more than one value
/// @param rows  the subject is defined in one at least
std::string heat_map(const Plan& plan, const std::vector<PointResult>& rows, std::size_t upward,
                     std::size_t rightward) {
  const Grid& grid = plan.grid();
  const Subject series = subject(plan);
  const std::vector<Cell> up = cells(grid.axes()[upward]);
  const std::vector<Cell> right = cells(grid.axes()[rightward]);
  std::string defined;
  std::string undefined;
  for (const Cell& y : up) {
    for (const Cell& x : right) {
      const double value =
          rows[y.index * grid.stride(upward) + x.index * grid.stride(rightward)].*series.figure;
      fmt::format_to(std::back_inserter(std::isnan(value) ? undefined : defined),
                     "{} {} {} {} {} {} {}\n", between(grid.axes()[rightward], x.low, x.high),
                     between(grid.axes()[upward], y.low, y.high), x.low, x.high, y.low, y.high,
                     value);
    }
  }
  std::string script =
      output::data_block("defined", defined) + output::data_block("undefined", undefined);
  script += palette;
  script += axis_commands(grid.axes()[rightward], 'x') + axis_commands(grid.axes()[upward], 'y') +
            range_command(right, 'x') + range_command(up, 'y');
  script += fmt::format("set cblabel '{}'\nset autoscale cbfix\nset tics out nomirror\nunset key\n",
                        series.label);
  script += "plot $defined using 1:2:3:4:5:6:7 with boxxyerror fs solid noborder fc palette";
  if (!undefined.empty()) {
    script += fmt::format(
        ", $undefined using 1:2:3:4:5:6 with boxxyerror fs solid noborder fc rgb '{}'", grey);
  }
  return script + '\n';
}

/// Values side by side are not joined.
constexpr const char* joined = "linespoints pt 7 ps 0.4 lw 2";
constexpr const char* apart = "points pt 7 ps 1.2";

constexpr const char* open_loop_plot =
    "$defined using 1:3 with {0} lc rgb '#9ecae1' title 'whole run', "
    "$defined using 1:2 with {0} lc rgb '#3b528b' title 'window'";
constexpr const char* closed_loop_plot =
    "$defined using 1:2:3 with yerrorbars pt 7 ps 0.5 lw 1.5 lc rgb '#3b528b' "
    "title 'steady error ± ripple'";

/// A gnuplot script: the friction ratio over window and whole run against the key; in closed loop
/// the steady error with the ripple on either side. Failed points are grey lines from bottom to
/// top. Other axes have one value.
/// @param axis  with more than one value
std::string curve(const Plan& plan, const std::vector<PointResult>& rows, std::size_t axis) {
  const Subject series = subject(plan);
  const Axis& drawn = plan.grid().axes()[axis];
  std::string defined;
  std::string failed;
  for (std::size_t point = 0; point < rows.size(); ++point) {
    const PointResult& row = rows[point];
    const double x = drawn.position(plan.grid().index(point, axis));
    fmt::format_to(std::back_inserter(defined), "{} {} {}\n", x, row.*series.figure,
                   plan.closed_loop() ? row.ripple : row.friction_ratio_whole_run);
    if (!row.ok()) {
      failed += fmt::format("{}\n", x);
    }
  }
  std::string script =
      output::data_block("defined", defined) + output::data_block("failed", failed);
  script += axis_commands(drawn, 'x');
  script += fmt::format(
      "set ylabel '{}'\nset y2range [0:1]\nset grid lc rgb '#d8d8d8'\nset tics out nomirror\n"
      "set key outside top center horizontal\nplot ",
      series.label);
  if (!failed.empty()) {
    script += "$failed using 1:(1) axes x1y2 with impulses lw 2 lc rgb '#b8b8b8' title 'failed', ";
  }
  return script +
         (plan.closed_loop() ? std::string(closed_loop_plot)
                             : fmt::format(open_loop_plot, drawn.categorical() ? apart : joined)) +
         '\n';
}

constexpr const char* colours[] = {"#1f5fa8", "#b8570f", "#1b9e5a", "#d62728",
                                   "#7a3fa0", "#111111", "#a6761d", "#e377c2"};
constexpr int markers[] = {7, 5, 9, 11, 13, 15, 4};

/// The points of one member; a gap where one failed.
std::string member_data(const Plan& plan, const std::vector<PointResult>& rows, std::size_t along,
                        std::size_t first) {
  const Grid& grid = plan.grid();
  const Subject series = subject(plan);
  std::string data;
  for (std::size_t i = 0; i < grid.axes()[along].count; ++i) {
    const double value = rows[first + i * grid.stride(along)].*series.figure;
    if (std::isfinite(value)) {
      fmt::format_to(std::back_inserter(data), "{} {}\n", grid.axes()[along].number(i), value);
    } else {
      data += '\n';
    }
  }
  return data;
}

/// A gnuplot script: the sweep's subject() against the one key, a curve for each value of the
/// other; failed points are left out. Other axes have one value.
/// @param along   with more than one value, not categorical
/// @param family  categorical
std::string curve_family(const Plan& plan, const std::vector<PointResult>& rows, std::size_t along,
                         std::size_t family) {
  const Grid& grid = plan.grid();
  const Axis& members = grid.axes()[family];
  std::string script;
  std::string curves;
  for (std::size_t i = 0; i < members.count; ++i) {
    script += output::data_block(fmt::format("member_{}", i),
                                 member_data(plan, rows, along, i * grid.stride(family)));
    curves += fmt::format(
        "{}$member_{} using 1:2 with linespoints pt {} ps 0.5 lw 2 lc rgb '{}' title {} noenhanced",
        i == 0 ? "plot " : ", ", i, markers[i % std::size(markers)],
        colours[i % std::size(colours)], output::quoted(members.text(i)));
  }
  return script + axis_commands(grid.axes()[along], 'x') +
         fmt::format(
             "set ylabel {}\nset grid lc rgb '#d8d8d8'\nset tics out nomirror\n"
             "set key outside top center horizontal title {} noenhanced\n",
             output::quoted(subject(plan).label), output::quoted(members.key)) +
         curves + '\n';
}

constexpr int width_px = 900;
constexpr int height_px = 560;

/// @param axes  one or two
std::string script(const Plan& plan, const std::vector<PointResult>& rows,
                   const std::vector<std::size_t>& axes) {
  if (axes.size() == 1) {
    return curve(plan, rows, axes[0]);
  }
  if (is_heat_map(plan.grid())) {
    return heat_map(plan, rows, axes[0], axes[1]);
  }
  const bool first_by_name = plan.grid().axes()[axes[0]].categorical();
  return first_by_name ? curve_family(plan, rows, axes[1], axes[0])
                       : curve_family(plan, rows, axes[0], axes[1]);
}

}  // namespace

std::vector<std::size_t> drawn_axes(const Grid& grid) {
  std::vector<std::size_t> drawn;
  for (std::size_t axis = 0; axis < grid.axes().size(); ++axis) {
    if (grid.axes()[axis].count > 1) {
      drawn.push_back(axis);
    }
  }
  return drawn;
}

bool is_heat_map(const Grid& grid) {
  const std::vector<std::size_t> drawn = drawn_axes(grid);
  return drawn.size() == 2 &&
         grid.axes()[drawn[0]].categorical() == grid.axes()[drawn[1]].categorical();
}

std::optional<std::string> draw(const Plan& plan, const std::vector<PointResult>& rows) {
  const std::vector<std::size_t> axes = drawn_axes(plan.grid());
  if (axes.empty() || axes.size() > 2 || !extremes(rows, subject(plan).figure)) {
    return std::nullopt;
  }
  return output::draw_svg(script(plan, rows, axes), width_px, height_px);
}

}  // namespace sonoglide::sweep
