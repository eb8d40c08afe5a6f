/// Error against run time, measured.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/output/study_report.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/work_precision/peers/contender.hpp"
#include "host_sim/studies/work_precision/solvers.hpp"

namespace sonoglide::work_precision {

// From a scene to the motion that is compared.

/// Longer runs add nothing to a comparison but time.
inline constexpr int most_periods = 1000;

/// A comparison needs an open loop, a carrier, a Dahl contact with friction, a constant sliding
/// velocity and a whole number of carrier periods; [solver] and the recording play no part.
/// @throws configure::ConfigurationError  names the key that stands in the way
peers::Problem problem_of(const scene::Scene& scene);

// The motion computed by another method, in higher precision, far more finely.

/// How a reference is computed.
struct ReferenceSetting {
  int columns;            ///< of the extrapolation; the order is twice that
  long double tolerance;  ///< of each step, absolute
};

struct Reference {
  long double friction_ratio = 0.0L;  ///< mean phi over the whole run
  long double displacement = 0.0L;    ///< y at the end
  long double velocity = 0.0L;        ///< y' at the end
  long double friction = 0.0L;        ///< phi at the end
};

/// Gragg–Bulirsch–Stoer extrapolation in long double between the reversals of V, each of them a
/// step whose length is solved so that V = 0 at its end. Friction is a function of the distance
/// slid since the reversal, phi = s - s e0 exp(-kappa |u|), and no unknown of its own.
///
/// The friction ratio of the published cases is reached within 1e-15 where long double has 64 bits
/// of mantissa or more; tested against values of 25 digits.
/// @throws loop::ComputationError if the steps shrink to nothing
Reference compute_reference(const peers::Problem& problem, const ReferenceSetting& setting);

struct CheckedReference {
  Reference motion;
  long double error = 0.0L;  ///< of the friction ratio, absolute: how far a second run is from it
};

/// The reference of a comparison, and the same at a lower order and a looser tolerance.
CheckedReference checked_reference(const peers::Problem& problem);

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

// Which solver is the cheapest at a given accuracy.

/// A row and the error that it can be relied on for: the largest of its own and those of the next
/// two finer settings of its solver. The error of a single number passes through zero at some
/// settings by chance; a user who does not know the answer cannot choose by that.
struct Standing {
  const MeasuredSetting* row;
  double error;
};

/// The standings of one solver's rows, those that failed left out, coarsest first.
std::vector<Standing> standings(const SolverComparison& comparison, const ComparedSolver& solver);

/// Those that no other standing of the solver beats in both error and time, cheapest first.
std::vector<Standing> frontier(const SolverComparison& comparison, const ComparedSolver& solver);

/// For each solver the cheapest of its settings that can be relied on for the error, cheapest
/// solver first; solvers that have none are left out. The rows live as long as the comparison.
std::vector<const MeasuredSetting*> cheapest(const SolverComparison& comparison,
                                             double error_bound);

/// The row of a solver at one setting; null if there is none.
const MeasuredSetting* find(const SolverComparison& comparison, const char* solver, double setting);

/// The solvers that have a row that did not fail, in the order of the rows.
std::vector<const ComparedSolver*> measured_solvers(const SolverComparison& comparison);

// What a comparison leaves behind.

/// One line for each row under a heading line; what was not measured is `nan`.
std::string to_csv(const SolverComparison& comparison);

output::Page page(const scene::Scene& scene, const SolverComparison& comparison);

/// Time for a carrier period against error, both axes logarithmic: one line for each solver through
/// the errors that its settings can be relied on for (see Standing), small points at the errors
/// that they happened to have.
output::Sheet diagram(const scene::Scene& scene, const SolverComparison& comparison);

/// work_precision.csv, work_precision.svg and report.html. @throws process::ProcessError
output::StudyReport report(const scene::Scene& scene, const SolverComparison& comparison);

}  // namespace sonoglide::work_precision
