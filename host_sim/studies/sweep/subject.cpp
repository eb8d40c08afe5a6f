#include "host_sim/studies/sweep/subject.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host_sim/output/gnuplot.hpp"

namespace sonoglide::sweep {

Subject subject(const Plan& plan) {
  return plan.closed_loop()
             ? Subject{&PointResult::steady_error, "Steady error of the friction ratio [-]"}
             : Subject{&PointResult::friction_ratio_window, "Friction ratio, window [-]"};
}

std::string axis_commands(const Axis& axis, char letter) {
  std::string commands = fmt::format("set {0}label {1} noenhanced\nset format {0} '%g'\n", letter,
                                     output::quoted(axis.key));
  if (axis.categorical()) {
    std::string tics;
    for (std::size_t index = 0; index < axis.count; ++index) {
      tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", output::quoted(axis.text(index)),
                          axis.position(index));
    }
    return commands + fmt::format("set {0}tics noenhanced ({1})\nset {0}range [0.5:{2}.5]\n",
                                  letter, tics, axis.count);
  }
  // A logarithmic axis of negative values is drawn on a linear scale.
  if (axis.logarithmic && axis.from > 0.0) {
    commands += fmt::format("set logscale {}\n", letter);
    // Within one decade the ticks are no powers of ten.
    if (std::abs(std::log10(axis.to / axis.from)) >= 1.0) {
      commands += fmt::format("set format {} '10^{{%L}}'\n", letter);
    }
  }
  return commands;
}

std::optional<ExtremePoints> extremes(const std::vector<PointResult>& rows,
                                      double PointResult::*figure) {
  std::optional<ExtremePoints> found;
  for (std::size_t point = 0; point < rows.size(); ++point) {
    const double value = rows[point].*figure;
    if (std::isnan(value)) {
      continue;
    }
    if (!found) {
      found = ExtremePoints{point, point};
    }
    if (value < rows[found->lowest].*figure) {
      found->lowest = point;
    }
    if (value > rows[found->highest].*figure) {
      found->highest = point;
    }
  }
  return found;
}

}  // namespace sonoglide::sweep
