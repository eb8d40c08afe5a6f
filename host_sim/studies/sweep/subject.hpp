/// What the pictures of a sweep show.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

struct Subject {
  double PointResult::*figure;
  std::string label;  ///< with its unit
};

/// The friction ratio over the window; in closed loop the steady error of the last target step.
Subject subject(const Plan& plan);

/// The gnuplot commands for an axis, `x` or `y`: its label, its scale where that is logarithmic,
/// and the names of values that stand side by side.
std::string axis_commands(const Axis& axis, char letter);

struct ExtremePoints {
  std::size_t lowest;   ///< point
  std::size_t highest;  ///< point
};

/// The first point of several with the same value; absent where the figure is NaN in every row.
std::optional<ExtremePoints> extremes(const std::vector<PointResult>& rows,
                                      double PointResult::*figure);

}  // namespace sonoglide::sweep
