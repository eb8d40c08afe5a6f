/// Where in step (or tolerance) and contact stiffness a solver can be trusted.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <cstddef>
#include <functional>
#include <mutex>
#include <string_view>
#include <vector>

#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability {

// Independent pieces of work on every core.

/// Told the part that is done, from 0 to 1; never from two threads at once.
using Progress = std::function<void(double)>;

/// Calls work(i) once for each i below count, `batch` of them between two reports of progress.
template <class Work>
void for_each_index(std::size_t count, std::size_t batch, const Progress& progress,
                    const Work& work) {
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, batch),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          work(i);
        }
        const std::lock_guard<std::mutex> lock(mutex);
        done += range.size();
        progress(static_cast<double>(done) / static_cast<double>(count));
      },
      tbb::simple_partitioner());
}

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
