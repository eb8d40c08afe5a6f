/// The solvers whose limits are drawn.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability {

/// A solver in one arithmetic.
struct TriedPrecision {
  std::string_view name;
  Trial trial;
  double extreme_setting;  ///< tolerance or steps per period, for the random scenes
  double friction_bound;   ///< largest |F|/Fc that the solver lets pass
};

struct TriedSolver {
  std::string name;
  bool adaptive;  ///< set by a tolerance, else by a number of steps per period
  std::array<TriedPrecision, 2> precisions;  ///< float64, float32
};

const std::vector<TriedSolver>& solvers();

}  // namespace sonoglide::stability
