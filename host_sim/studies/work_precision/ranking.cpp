#include "host_sim/studies/work_precision/ranking.hpp"

#include <algorithm>
#include <cstddef>

namespace sonoglide::work_precision {
namespace {

/// Half a decade of steps, one and a half of a tolerance.
constexpr std::size_t finer_neighbours = 2;

bool cheaper(const MeasuredSetting* a, const MeasuredSetting* b) {
  return a->wall_us_per_period < b->wall_us_per_period;
}

}  // namespace

std::vector<Standing> standings(const SolverComparison& comparison, const ComparedSolver& solver) {
  std::vector<Standing> all;
  for (const MeasuredSetting& row : comparison.rows) {
    if (row.solver == &solver && row.ok()) {
      all.push_back({&row, row.error});
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i; j < all.size() && j <= i + finer_neighbours; ++j) {
      all[i].error = std::max(all[i].error, all[j].row->error);
    }
  }
  return all;
}

std::vector<Standing> frontier(const SolverComparison& comparison, const ComparedSolver& solver) {
  std::vector<Standing> all = standings(comparison, solver);
  std::sort(all.begin(), all.end(),
            [](const Standing& a, const Standing& b) { return cheaper(a.row, b.row); });
  std::vector<Standing> kept;
  for (const Standing& standing : all) {
    if (kept.empty() || standing.error < kept.back().error) {
      kept.push_back(standing);
    }
  }
  return kept;
}

std::vector<const MeasuredSetting*> cheapest(const SolverComparison& comparison,
                                             double error_bound) {
  std::vector<const MeasuredSetting*> rows;
  for (const ComparedSolver* solver : measured_solvers(comparison)) {
    const std::vector<Standing> kept = frontier(comparison, *solver);
    const auto first = std::find_if(kept.begin(), kept.end(), [error_bound](const Standing& s) {
      return s.error <= error_bound;
    });
    if (first != kept.end()) {
      rows.push_back(first->row);
    }
  }
  std::sort(rows.begin(), rows.end(), cheaper);
  return rows;
}

const MeasuredSetting* find(const SolverComparison& comparison, const char* solver,
                            double setting) {
  const auto row =
      std::find_if(comparison.rows.begin(), comparison.rows.end(),
                   [solver, setting](const MeasuredSetting& candidate) {
                     return candidate.solver->name == solver && candidate.setting == setting;
                   });
  return row == comparison.rows.end() ? nullptr : &*row;
}

std::vector<const ComparedSolver*> measured_solvers(const SolverComparison& comparison) {
  std::vector<const ComparedSolver*> solvers;
  for (const MeasuredSetting& row : comparison.rows) {
    if (row.ok() && (solvers.empty() || solvers.back() != row.solver)) {
      solvers.push_back(row.solver);
    }
  }
  return solvers;
}

}  // namespace sonoglide::work_precision
