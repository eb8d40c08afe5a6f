/// Where in step (or tolerance) and contact stiffness a solver can be trusted.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "host_sim/studies/stability/parallel.hpp"
#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability {

/// Relative error of the whole-run friction ratio up to which a run counts as accurate.
inline constexpr double accurate_error = 1e-3;

struct MapGrid {
  std::vector<double> contact_stiffness_N_per_m;
  std::vector<double> tolerance;         ///< for adaptive solvers
  std::vector<double> steps_per_period;  ///< for the others
  int periods = 0;                       ///< carrier periods, from rest
};

/// Stiffness 1e2..1e13 N/m, tolerance 1e-2..1e-14, 8..32768 steps per period; 10 periods.
MapGrid full_grid();

struct MapCell {
  double setting;
  double contact_stiffness_N_per_m;
  Verdict verdict;
  double relative_error;  ///< NaN unless the solver handed over a finite result
};

/// Cells in the order of the settings, each with all its stiffnesses.
struct SolverMap {
  std::string_view solver;
  std::string_view precision;
  bool adaptive;
  std::vector<MapCell> cells;
};

struct StabilityMaps {
  MapGrid grid;
  std::vector<SolverMap> maps;  ///< by precision, then as the solvers are listed
  /// The largest relative difference between the reference, event_taylor of order 16 at 1e-12, and
  /// order 12 at 1e-13.
  double reference_difference;
};

/// The paper's Table 1 driven by 384 N at half the peak vibration velocity, from rest.
StabilityMaps stability_maps(const MapGrid& grid, const Progress& progress);

/// Steps per carrier period below which classical Runge–Kutta is unstable in a full slide of that
/// scene: h = 2.785 Fc/(Kt |V|max).
double rk4_limit_steps_per_period(double contact_stiffness_N_per_m);

}  // namespace sonoglide::stability
