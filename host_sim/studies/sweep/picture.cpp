#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/sweep/curve.hpp"
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

}  // namespace

std::string heat_map(const Plan& plan, const std::vector<PointResult>& rows, std::size_t upward,
                     std::size_t rightward) {
  const Grid& grid = plan.grid();
  const Subject shown = subject(plan);
  const std::vector<Cell> up = cells(grid.axes()[upward]);
  const std::vector<Cell> right = cells(grid.axes()[rightward]);
  std::string defined;
  std::string undefined;
  for (const Cell& y : up) {
    for (const Cell& x : right) {
      const double value =
          rows[y.index * grid.stride(upward) + x.index * grid.stride(rightward)].*shown.figure;
      fmt::format_to(std::back_inserter(std::isnan(value) ? undefined : defined),
                     "{} {} {} {} {} {} {}\n", between(grid.axes()[rightward], x.low, x.high),
                     between(grid.axes()[upward], y.low, y.high), x.low, x.high, y.low, y.high,
                     value);
    }
  }
  std::string script =
      fmt::format("$defined << EOD\n{}EOD\n$undefined << EOD\n{}EOD\n", defined, undefined);
  script += palette;
  script += axis_commands(grid.axes()[rightward], 'x') + axis_commands(grid.axes()[upward], 'y') +
            range_command(right, 'x') + range_command(up, 'y');
  script += fmt::format("set cblabel '{}'\nset autoscale cbfix\nset tics out nomirror\nunset key\n",
                        shown.label);
  script += "plot $defined using 1:2:3:4:5:6:7 with boxxyerror fs solid noborder fc palette";
  if (!undefined.empty()) {
    script += fmt::format(
        ", $undefined using 1:2:3:4:5:6 with boxxyerror fs solid noborder fc rgb '{}'", grey);
  }
  return script + '\n';
}

namespace {

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
