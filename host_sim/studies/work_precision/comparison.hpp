/// Error against run time, measured.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "host_sim/studies/work_precision/peers/contender.hpp"
#include "host_sim/studies/work_precision/reference.hpp"
#include "host_sim/studies/work_precision/solvers.hpp"

namespace sonoglide::work_precision {

inline constexpr const char* status_ok = "ok";

/// One solver at one setting. What was not measured is not a number.
struct MeasuredSetting {
  const ComparedSolver* solver = nullptr;
  double setting = 0.0;
  double error = std::numeric_limits<double>::quiet_NaN();  ///< of the friction ratio
  double wall_us_per_period = std::numeric_limits<double>::quiet_NaN();
  double steps_per_period = std::numeric_limits<double>::quiet_NaN();
  std::string status = status_ok;  ///< otherwise why it failed

  bool ok() const { return status == status_ok; }
};

struct SolverComparison {
  int periods = 0;
  CheckedReference reference;
  bool absolute_error = false;  ///< the friction ratio is about 0: errors are not relative to it
  std::vector<MeasuredSetting> rows;  ///< solver by solver, settings from coarse to fine
};

/// How much time a comparison may take.
struct Effort {
  double slowest_run_s = 0.6;  ///< a run that would take longer is broken off: "too slow"
  double repeats_s = 0.12;     ///< repeats of one row end after this much time
  int most_repeats = 30;
};

/// Runs every solver at every setting.
///
/// The error is that of the mean of phi over the whole run. The wall time is the smallest of
/// several runs on one thread, each over the carrier periods alone; all solvers take turns, so that
/// what disturbs the machine disturbs them alike.
///
/// @param progress  called with the part done, 0 to 1; may be empty
SolverComparison compare(const peers::Problem& problem, const std::vector<ComparedSolver>& solvers,
                         const Effort& effort, const std::function<void(double)>& progress);

}  // namespace sonoglide::work_precision
