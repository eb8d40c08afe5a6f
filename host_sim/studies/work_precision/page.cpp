#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <utility>

#include "host_sim/output/chart.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/studies/work_precision/comparison.hpp"

namespace sonoglide::work_precision {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown processor";
}

std::string architecture() {
  utsname system{};
  return uname(&system) == 0 ? std::string(system.machine) : std::string("unknown architecture");
}

constexpr const char* compiler_name() {
#ifdef __clang__
  return "clang";
#else
  return "gcc";
#endif
}

constexpr const char* optimisation() {
#ifdef __OPTIMIZE__
  return "optimised";
#else
  return "not optimised: the times mean nothing";
#endif
}

/// Processor and compiler, in one line.
std::string machine() {
  return fmt::format("{}, {}, {} {}, {}", processor(), architecture(), compiler_name(), __VERSION__,
                     optimisation());
}

constexpr std::array<double, 4> accuracies = {1e-4, 1e-6, 1e-8, 1e-10};
/// The paper's step, 1.667e-8 s at 60 kHz.
constexpr double paper_steps_per_period = 1000.0;

const char* kind_of_error(const SolverComparison& comparison) {
  return comparison.absolute_error ? "Absolute error" : "Relative error";
}

/// Whole numbers from a thousand on, as nobody reads 1.8e+03.
std::string number(double value) {
  const bool is_large = value >= 999.5 && value < 1e6;
  return !std::isfinite(value) ? std::string("–")
         : is_large            ? fmt::format("{:.0f}", value)
                               : fmt::format("{:.3g}", value);
}

std::string lead(const scene::Scene& scene, const SolverComparison& comparison) {
  return fmt::format(
      "Error against run time of every solver on the scene {}, {} carrier periods. The error is "
      "that of the friction ratio over the whole run{}. The time is the smallest of several runs "
      "on one thread, over the carrier periods alone; the solvers take turns. A setting is counted "
      "within an error if the next two finer ones of its solver are too: the error of one number "
      "passes through zero at some settings by chance.",
      scene.name, comparison.periods,
      comparison.absolute_error ? ", absolute because the ratio is about 0" : "");
}

output::Table set_up(const SolverComparison& comparison) {
  const Reference& motion = comparison.reference.motion;
  return {"Reference and machine",
          {},
          {{"Friction ratio of the reference",
            fmt::format("{:.16f}", static_cast<double>(motion.friction_ratio))},
           {"Its own error, from a second run at a lower order",
            fmt::format("{:.1e}", static_cast<double>(comparison.reference.error))},
           {"Method of the reference",
            "Gragg–Bulirsch–Stoer extrapolation, long double, steps that end at the reversals"},
           {"Machine and compiler", machine()}}};
}

output::Table ranking(const SolverComparison& comparison, double accuracy) {
  output::Table table{
      fmt::format("Cheapest setting of each solver within an error of {:.0e}", accuracy),
      {"Solver", "Setting", kind_of_error(comparison), "Time per period [µs]", "Steps per period",
       "Times the fastest"},
      {}};
  const std::vector<const MeasuredSetting*> rows = cheapest(comparison, accuracy);
  for (const MeasuredSetting* row : rows) {
    table.rows.push_back({row->solver->name, setting_text(row->solver->knob, row->setting),
                          number(row->error), number(row->wall_us_per_period),
                          number(row->steps_per_period),
                          number(row->wall_us_per_period / rows.front()->wall_us_per_period)});
  }
  return table;
}

/// Empty where the paper's run failed.
output::Table against_the_paper(const SolverComparison& comparison) {
  const MeasuredSetting* paper = find(comparison, "rk4_table", paper_steps_per_period);
  output::Table table{
      "The paper's run, and the fastest that is at least as accurate",
      {"Solver", "Setting", kind_of_error(comparison), "Time per period [µs]", "Times the fastest"},
      {}};
  if (paper == nullptr) {
    return table;
  }
  if (!paper->ok()) {
    table.rows.push_back({paper->solver->name, setting_text(Knob::steps_per_period, paper->setting),
                          paper->status, "–", "–"});
    return table;
  }
  std::vector<const MeasuredSetting*> rows = cheapest(comparison, paper->error);
  rows.resize(std::min<std::size_t>(rows.size(), 1));
  rows.push_back(paper);
  for (const MeasuredSetting* row : rows) {
    table.rows.push_back({row->solver->name, setting_text(row->solver->knob, row->setting),
                          number(row->error), number(row->wall_us_per_period),
                          number(row->wall_us_per_period / rows.front()->wall_us_per_period)});
  }
  return table;
}

output::Table every_row(const SolverComparison& comparison) {
  output::Table table{"Every setting",
                      {"Solver", "Setting", kind_of_error(comparison), "Time per period [µs]",
                       "Steps per period", "Status"},
                      {}};
  for (const MeasuredSetting& row : comparison.rows) {
    table.rows.push_back({row.solver->name, setting_text(row.solver->knob, row.setting),
                          number(row.error), number(row.wall_us_per_period),
                          number(row.steps_per_period), row.status});
  }
  return table;
}

/// Errors at and below the rounding of the result are drawn here.
constexpr double smallest_error = 1e-16;

/// Colours of one hue for a family, a marker of its own for each member.
output::Pen pen_of(Family family, std::size_t member) {
  static constexpr const char* blues[] = {"#7fb2e5", "#3f87cf", "#1f5fa8", "#0b3a70"};
  static constexpr const char* oranges[] = {"#e6a817", "#b8570f"};
  static constexpr const char* greens[] = {"#1b9e5a", "#66a61e", "#a6761d"};
  static constexpr const char* greys[] = {"#111111", "#808080"};
  static constexpr const char* reds[] = {"#d62728", "#e377c2", "#9467bd", "#ff7f0e"};
  static constexpr const char* pales[] = {"#7fb2e5", "#3f87cf", "#1f5fa8", "#0b3a70",
                                          "#1b9e5a", "#66a61e", "#a6761d"};
  static constexpr int markers[] = {7, 5, 9, 11, 13, 15, 4};
  constexpr double size = 0.55;
  const int marker = markers[member % 7];
  switch (family) {
    case Family::blue:
      return {blues[member % 4], 2.4, 1, marker, size};
    case Family::orange:
      return {oranges[member % 2], 2.4, 1, marker, size};
    case Family::green:
      return {greens[member % 3], 2.0, 1, marker, size};
    case Family::single:
      return {pales[member % 7], 1.2, 3, marker, size};
    case Family::paper:
      return {greys[member % 2], 2.0, 1, marker, size};
    case Family::outside_peer:
      break;
  }
  return {reds[member % 4], 2.0, 1, marker, size};
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

void add(output::Curve& curve, double error, const MeasuredSetting& row) {
  curve.x.push_back(std::max(error, smallest_error));
  curve.y.push_back(row.wall_us_per_period);
}

/// Small points for all settings, and a line for each solver over them.
std::vector<output::Curve> curves(const SolverComparison& comparison) {
  std::vector<output::Curve> points;
  std::vector<output::Curve> lines;
  for (const ComparedSolver* solver : measured_solvers(comparison)) {
    const output::Pen pen = pen_of(solver->family, member_of(comparison, *solver));
    output::Curve& all = points.emplace_back(
        output::Curve{"", {}, output::Line::dots, {}, {pen.colour, 1, 1, 7, 0.2}});
    for (const Standing& standing : standings(comparison, *solver)) {
      add(all, standing.row->error, *standing.row);
    }
    output::Curve& best =
        lines.emplace_back(output::Curve{solver->name, {}, output::Line::joined, {}, pen});
    best.verbatim = true;
    for (const Standing& standing : frontier(comparison, *solver)) {
      add(best, standing.error, *standing.row);
    }
  }
  points.insert(points.end(), lines.begin(), lines.end());
  return points;
}

}  // namespace

output::Sheet diagram(const scene::Scene& scene, const SolverComparison& comparison) {
  output::Chart chart{fmt::format("{}, {} carrier periods", scene.name, comparison.periods),
                      "",
                      {fmt::format("{} error of the friction ratio over the whole run",
                                   comparison.absolute_error ? "Absolute" : "Relative"),
                       true,
                       {0.5 * smallest_error, 2.0},
                       "10^{%T}"},
                      {"Time for one carrier period [µs]", true, {}, "10^{%T}"},
                      {},
                      curves(comparison)};
  chart.verbatim = true;
  chart.look = chart.curves.empty() ? "set yrange [1:1000]\n" : "set yrange [0.1 <*:*]\n";
  return {{std::move(chart)},
          1120,
          720,
          0,
          "set title font ',15'\nset xtics 100 nomirror\nset ytics nomirror\n"
          "set grid xtics ytics lc rgb '#d8d8d8' lw 1\nset border 3\n"
          "set key outside right top vertical Left reverse samplen 3 spacing 1.25\n"};
}

output::Page page(const scene::Scene& scene, const SolverComparison& comparison) {
  output::Page page;
  page.title = "Work and precision: " + scene.name;
  page.lead = lead(scene, comparison);
  page.scene = scene_file::to_json(scene);
  page.tables.push_back(against_the_paper(comparison));
  output::Chart chart = diagram(scene, comparison).charts.front();
  chart.title = "Time for a carrier period against error";
  chart.note =
      "Lower and further left is better. A line shows the error that a solver can be relied on "
      "for, the worst of a setting and its next two finer ones; small points show the error that "
      "each setting happened to have.";
  page.sections = {{"Work-precision diagram", "", {std::move(chart)}}, {"Settings", "", {}}};
  std::vector<output::Table>& tables = page.sections.back().tables;
  for (const double accuracy : accuracies) {
    tables.push_back(ranking(comparison, accuracy));
  }
  tables.push_back(every_row(comparison));
  tables.push_back(set_up(comparison));
  return page;
}

}  // namespace sonoglide::work_precision
