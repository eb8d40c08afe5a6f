#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "host_sim/output/chart.hpp"
#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/sweep/report.hpp"

namespace sonoglide::sweep {
namespace {

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

output::Span span(const std::vector<Cell>& cells) {
  return {std::min(cells.front().low, cells.back().low),
          std::max(cells.front().high, cells.back().high)};
}

/// Its label, its scale where that is logarithmic, and the names of values that stand side by side.
output::Axis drawn(const Axis& axis) {
  output::Axis drawn{axis.key, false, {}, "%g"};
  drawn.verbatim = true;
  if (axis.categorical()) {
    for (std::size_t index = 0; index < axis.count; ++index) {
      drawn.ticks.push_back({axis.position(index), axis.text(index)});
    }
    drawn.span = {0.5, static_cast<double>(axis.count) + 0.5};
  } else if (axis.logarithmic && axis.from > 0.0) {
    // One of negative values is drawn on a linear scale.
    drawn.logarithmic = true;
    // Within one decade the ticks are no powers of ten.
    if (std::abs(std::log10(axis.to / axis.from)) >= 1.0) {
      drawn.format = "10^{%L}";
    }
  }
  return drawn;
}

/// One cell for each point in the colour of the sweep's subject(), grey where that is not defined.
/// Other axes stay at their first value.
/// @param upward, rightward  axes with more than one value
/// @param rows  the subject is defined in one at least
output::Chart heat_map(const Plan& plan, const std::vector<PointResult>& rows, std::size_t upward,
                       std::size_t rightward) {
  const Grid& grid = plan.grid();
  const Subject series = subject(plan);
  const std::vector<Cell> up = cells(grid.axes()[upward]);
  const std::vector<Cell> right = cells(grid.axes()[rightward]);
  output::Tiles defined;
  output::Tiles undefined{{}, grey, "not defined"};
  for (const Cell& y : up) {
    for (const Cell& x : right) {
      const double value =
          rows[y.index * grid.stride(upward) + x.index * grid.stride(rightward)].*series.figure;
      (std::isnan(value) ? undefined : defined)
          .all.push_back({{x.low, x.high}, {y.low, y.high}, value});
    }
  }
  output::Chart chart{"", "", drawn(grid.axes()[rightward]), drawn(grid.axes()[upward]), {}, {}};
  chart.x_axis.span = span(right);
  chart.y_axis.span = span(up);
  chart.tiles = {std::move(defined)};
  if (!undefined.all.empty()) {
    chart.tiles.push_back(std::move(undefined));
  }
  chart.look = fmt::format("set cblabel '{}'\nset autoscale cbfix\nunset key\n", series.label);
  return chart;
}

constexpr const char* key_above =
    "set grid lc rgb '#d8d8d8'\nset key outside top center horizontal";

/// The indices along an axis from left to right: one whose values fall is drawn from its end.
std::vector<std::size_t> rightward(const Axis& axis) {
  std::vector<std::size_t> indices(axis.count);
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  if (axis.position(axis.count - 1) < axis.position(0)) {
    std::reverse(indices.begin(), indices.end());
  }
  return indices;
}

/// The sweep's subject() against the key: a steady error with the ripple on either side, the friction ratio
/// of the window with that of the whole run, any other alone. Failed points are grey lines from bottom to
/// top. Other axes have one value.
/// @param axis  with more than one value
output::Chart curve(const Plan& plan, const std::vector<PointResult>& rows, std::size_t axis) {
  const Subject series = subject(plan);
  const Axis& along = plan.grid().axes()[axis];
  output::Curve failed{"failed", {}, output::Line::full_height, {}, {grey}};
  const std::vector<std::size_t> points = rightward(along);
  std::vector<double> x;
  for (const std::size_t point : points) {
    x.push_back(along.position(point));
    if (!rows[point].ok()) {
      failed.x.push_back(x.back());
      failed.y.push_back(1.0);
    }
  }
  output::Chart chart{"", "", drawn(along), {series.label}, std::move(x), {}};
  if (!failed.y.empty()) {
    chart.curves.push_back(std::move(failed));
  }
  const auto column = [&](double PointResult::*figure) {
    std::vector<double> values(points.size());
    std::transform(points.begin(), points.end(), values.begin(),
                   [&](std::size_t point) { return rows[point].*figure; });
    return values;
  };
  // Values side by side are not joined.
  const bool apart = along.categorical();
  const auto add = [&](const std::string& label, double PointResult::*figure, const char* colour) {
    chart.curves.push_back({label,
                            column(figure),
                            apart ? output::Line::dots : output::Line::joined,
                            {},
                            {colour, apart ? 1.0 : 2.0, 1, 7, apart ? 1.2 : 0.4}});
  };
  if (series.figure == &PointResult::steady_error) {
    chart.curves.push_back({"steady error ± ripple",
                            column(series.figure),
                            output::Line::joined,
                            {},
                            {"#3b528b", 1.5, 1, 7, 0.5},
                            column(&PointResult::ripple)});
  } else if (series.figure == &PointResult::friction_ratio_window) {
    add("whole run", &PointResult::friction_ratio_whole_run, "#9ecae1");
    add("window", series.figure, "#3b528b");
  } else {
    add(series.title, series.figure, "#3b528b");
  }
  chart.look = fmt::format("{}\n", key_above);
  return chart;
}

constexpr const char* colours[] = {"#1f5fa8", "#b8570f", "#1b9e5a", "#d62728",
                                   "#7a3fa0", "#111111", "#a6761d", "#e377c2"};
constexpr int markers[] = {7, 5, 9, 11, 13, 15, 4};

/// The sweep's subject() against the one key, a curve for each value of the other; a gap where a
/// point failed. Other axes have one value.
/// @param along   with more than one value, not categorical
/// @param family  categorical
output::Chart curve_family(const Plan& plan, const std::vector<PointResult>& rows,
                           std::size_t along, std::size_t family) {
  const Grid& grid = plan.grid();
  const Subject series = subject(plan);
  const Axis& members = grid.axes()[family];
  output::Chart chart{"", "", drawn(grid.axes()[along]), {series.label}, {}, {}};
  const std::vector<std::size_t> indices = rightward(grid.axes()[along]);
  for (const std::size_t k : indices) {
    chart.x.push_back(grid.axes()[along].number(k));
  }
  for (std::size_t i = 0; i < members.count; ++i) {
    output::Curve& member = chart.curves.emplace_back();
    member.label = members.text(i);
    member.verbatim = true;
    member.pen = {colours[i % std::size(colours)], 2.0, 1, markers[i % std::size(markers)], 0.5};
    for (const std::size_t k : indices) {
      member.y.push_back(rows[i * grid.stride(family) + k * grid.stride(along)].*series.figure);
    }
  }
  chart.look = fmt::format("{} title {} noenhanced\n", key_above, output::quoted(members.key));
  return chart;
}

/// @param axes  one or two
output::Chart chart(const Plan& plan, const std::vector<PointResult>& rows,
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

std::optional<output::Sheet> picture(const Plan& plan, const std::vector<PointResult>& rows) {
  const std::vector<std::size_t> axes = drawn_axes(plan.grid());
  if (axes.empty() || axes.size() > 2 || !extremes(rows, subject(plan).figure)) {
    return std::nullopt;
  }
  return output::Sheet{{chart(plan, rows, axes)}, 900, 560, 0, "set tics out nomirror\n"};
}

}  // namespace sonoglide::sweep
