/// Which solver is the cheapest at a given accuracy.
#pragma once

#include <vector>

#include "host_sim/studies/work_precision/comparison.hpp"

namespace sonoglide::work_precision {

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

}  // namespace sonoglide::work_precision
