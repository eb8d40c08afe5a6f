#include "host_sim/studies/work_precision/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/work_precision/ranking.hpp"

namespace sonoglide::work_precision {
namespace {

constexpr int width_px = 1120;
constexpr int height_px = 720;
/// Errors at and below the rounding of the result are drawn here.
constexpr double smallest_error = 1e-16;

struct Style {
  const char* colour;
  const char* dash;
  double width;
  int marker;
};

/// Colours of one hue for a family, a marker of its own for each member.
Style style_of(Family family, std::size_t member) {
  static constexpr const char* blues[] = {"#7fb2e5", "#3f87cf", "#1f5fa8", "#0b3a70"};
  static constexpr const char* oranges[] = {"#e6a817", "#b8570f"};
  static constexpr const char* greens[] = {"#1b9e5a", "#66a61e", "#a6761d"};
  static constexpr const char* greys[] = {"#111111", "#808080"};
  static constexpr const char* reds[] = {"#d62728", "#e377c2", "#9467bd", "#ff7f0e"};
  static constexpr const char* pales[] = {"#7fb2e5", "#3f87cf", "#1f5fa8", "#0b3a70",
                                          "#1b9e5a", "#66a61e", "#a6761d"};
  static constexpr int markers[] = {7, 5, 9, 11, 13, 15, 4};
  const int marker = markers[member % 7];
  switch (family) {
    case Family::blue:
      return {blues[member % 4], "1", 2.4, marker};
    case Family::orange:
      return {oranges[member % 2], "1", 2.4, marker};
    case Family::green:
      return {greens[member % 3], "1", 2.0, marker};
    case Family::single:
      return {pales[member % 7], "3", 1.2, marker};
    case Family::paper:
      return {greys[member % 2], "1", 2.0, marker};
    case Family::outside_peer:
      break;
  }
  return {reds[member % 4], "1", 2.0, marker};
}

/// The names under which gnuplot knows a solver's points.
std::string block(const char* kind, const ComparedSolver& solver) {
  return fmt::format("{}_{}", kind, solver.name);
}

std::string point(double error, const MeasuredSetting& row) {
  return fmt::format("{:.6g} {:.6g}\n", std::max(error, smallest_error), row.wall_us_per_period);
}

std::string data(const SolverComparison& comparison, const ComparedSolver& solver) {
  std::string all;
  for (const Standing& standing : standings(comparison, solver)) {
    all += point(standing.row->error, *standing.row);
  }
  std::string best;
  for (const Standing& standing : frontier(comparison, solver)) {
    best += point(standing.error, *standing.row);
  }
  return output::data_block(block("all", solver), all) +
         output::data_block(block("best", solver), best);
}

/// A solver's place in its family, the same whether or not the others could be measured.
std::size_t member_of(const SolverComparison& comparison, const ComparedSolver& solver) {
  std::size_t member = 0;
  const ComparedSolver* last = nullptr;
  for (const MeasuredSetting& row : comparison.rows) {
    if (row.solver == &solver) {
      break;
    }
    member += row.solver != last && row.solver->family == solver.family ? 1 : 0;
    last = row.solver;
  }
  return member;
}

std::string curves(const SolverComparison& comparison) {
  std::string points;
  std::string lines;
  for (const ComparedSolver* solver : measured_solvers(comparison)) {
    const Style style = style_of(solver->family, member_of(comparison, *solver));
    points += fmt::format("${} with points pt 7 ps 0.2 lc rgb '{}' notitle, \\\n",
                          block("all", *solver), style.colour);
    lines += fmt::format(
        "{}${} with linespoints lc rgb '{}' dt {} lw {} pt {} ps 0.55 title '{}' noenhanced",
        lines.empty() ? "" : ", \\\n", block("best", *solver), style.colour, style.dash,
        style.width, style.marker, solver->name);
  }
  return lines.empty() ? "set yrange [1:1000]\nplot NaN notitle\n"
                       : "plot " + points + lines + "\n";
}

}  // namespace

std::string draw(const SolverComparison& comparison, const std::string& title) {
  std::string script;
  for (const ComparedSolver* solver : measured_solvers(comparison)) {
    script += data(comparison, *solver);
  }
  script += fmt::format(
      "set title {} noenhanced font ',15'\n"
      "set logscale xy\n"
      "set format xy '10^{{%T}}'\n"
      "set xlabel '{} error of the friction ratio over the whole run'\n"
      "set ylabel 'Time for one carrier period [µs]'\n"
      "set xrange [{:g}:2]\n"
      "set yrange [0.1 <*:*]\n"
      "set xtics 100 nomirror\nset ytics nomirror\n"
      "set grid xtics ytics lc rgb '#d8d8d8' lw 1\n"
      "set border 3\n"
      "set key outside right top vertical Left reverse samplen 3 spacing 1.25\n",
      output::quoted(title), comparison.absolute_error ? "Absolute" : "Relative",
      0.5 * smallest_error);
  return output::draw_svg(script + curves(comparison), width_px, height_px);
}

}  // namespace sonoglide::work_precision
