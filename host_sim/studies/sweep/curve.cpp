#include "host_sim/studies/sweep/curve.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/sweep/subject.hpp"

namespace sonoglide::sweep {
namespace {

/// Values side by side are not joined.
constexpr const char* joined = "linespoints pt 7 ps 0.4 lw 2";
constexpr const char* apart = "points pt 7 ps 1.2";

constexpr const char* open_loop_plot =
    "$defined using 1:3 with {0} lc rgb '#9ecae1' title 'whole run', "
    "$defined using 1:2 with {0} lc rgb '#3b528b' title 'window'";
constexpr const char* closed_loop_plot =
    "$defined using 1:2:3 with yerrorbars pt 7 ps 0.5 lw 1.5 lc rgb '#3b528b' "
    "title 'steady error ± ripple'";

}  // namespace

std::string curve(const Plan& plan, const std::vector<PointResult>& rows, std::size_t axis) {
  const Subject shown = subject(plan);
  const Axis& drawn = plan.grid().axes()[axis];
  std::string defined;
  std::string failed;
  for (std::size_t point = 0; point < rows.size(); ++point) {
    const PointResult& row = rows[point];
    const double x = drawn.position(plan.grid().index(point, axis));
    fmt::format_to(std::back_inserter(defined), "{} {} {}\n", x, row.*shown.figure,
                   plan.closed_loop() ? row.ripple : row.friction_ratio_whole_run);
    if (!row.ok()) {
      failed += fmt::format("{}\n", x);
    }
  }
  std::string script =
      fmt::format("$defined << EOD\n{}EOD\n$failed << EOD\n{}EOD\n", defined, failed);
  script += axis_commands(drawn, 'x');
  script += fmt::format(
      "set ylabel '{}'\nset y2range [0:1]\nset grid lc rgb '#d8d8d8'\nset tics out nomirror\n"
      "set key outside top center horizontal\nplot ",
      shown.label);
  if (!failed.empty()) {
    script += "$failed using 1:(1) axes x1y2 with impulses lw 2 lc rgb '#b8b8b8' title 'failed', ";
  }
  return script +
         (plan.closed_loop() ? std::string(closed_loop_plot)
                             : fmt::format(open_loop_plot, drawn.categorical() ? apart : joined)) +
         '\n';
}

namespace {

constexpr const char* colours[] = {"#1f5fa8", "#b8570f", "#1b9e5a", "#d62728",
                                   "#7a3fa0", "#111111", "#a6761d", "#e377c2"};
constexpr int markers[] = {7, 5, 9, 11, 13, 15, 4};

/// The points of one member; a gap where one failed.
std::string member_data(const Plan& plan, const std::vector<PointResult>& rows, std::size_t along,
                        std::size_t first) {
  const Grid& grid = plan.grid();
  const Subject shown = subject(plan);
  std::string data;
  for (std::size_t i = 0; i < grid.axes()[along].count; ++i) {
    const double value = rows[first + i * grid.stride(along)].*shown.figure;
    if (std::isfinite(value)) {
      fmt::format_to(std::back_inserter(data), "{} {}\n", grid.axes()[along].number(i), value);
    } else {
      data += '\n';
    }
  }
  return data;
}

}  // namespace

std::string curve_family(const Plan& plan, const std::vector<PointResult>& rows, std::size_t along,
                         std::size_t family) {
  const Grid& grid = plan.grid();
  const Axis& members = grid.axes()[family];
  std::string script;
  std::string curves;
  for (std::size_t i = 0; i < members.count; ++i) {
    script += fmt::format("$member_{} << EOD\n{}EOD\n", i,
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

}  // namespace sonoglide::sweep
