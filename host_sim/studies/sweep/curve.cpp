#include "host_sim/studies/sweep/curve.hpp"

#include <fmt/format.h>

#include <iterator>

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

std::string curve(const Plan& plan, const std::vector<Row>& rows, std::size_t axis) {
  const Subject shown = subject(plan);
  const Axis& drawn = plan.grid().axes()[axis];
  std::string defined;
  std::string failed;
  for (std::size_t point = 0; point < rows.size(); ++point) {
    const Row& row = rows[point];
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

}  // namespace sonoglide::sweep
