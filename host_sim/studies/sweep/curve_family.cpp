#include "host_sim/studies/sweep/curve_family.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/sweep/subject.hpp"

namespace sonoglide::sweep {
namespace {

constexpr const char* colours[] = {"#1f5fa8", "#b8570f", "#1b9e5a", "#d62728",
                                   "#7a3fa0", "#111111", "#a6761d", "#e377c2"};
constexpr int markers[] = {7, 5, 9, 11, 13, 15, 4};

/// The points of one member; a gap where one failed.
std::string member_data(const Plan& plan, const std::vector<Row>& rows, std::size_t along,
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

std::string curve_family(const Plan& plan, const std::vector<Row>& rows, std::size_t along,
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
