#include "host_sim/studies/work_precision/comparison.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>

namespace sonoglide::work_precision {
namespace {

using Clock = std::chrono::steady_clock;

/// Below this a friction ratio swings about 0 and divides no error.
constexpr long double smallest_divisor = 1e-3L;
/// A prediction of the whole run from less than this is noise.
constexpr double least_prediction_s = 0.02;
/// Share of the first pass, which meets the slowest settings, in the whole.
constexpr double first_pass_share = 0.6;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A row on its way to being measured.
struct Trial {
  MeasuredSetting row;
  std::unique_ptr<peers::Contender> contender;
  double shortest_s = std::numeric_limits<double>::infinity();
  double spent_s = 0.0;

  void count(double run_s) {
    shortest_s = std::min(shortest_s, run_s);
    spent_s += run_s;
  }
};

/// The first run, period by period, so that one that is too slow can be broken off.
void first_run(Trial& trial, const peers::Problem& problem, const Effort& effort) {
  trial.contender->restart();
  const Clock::time_point start = Clock::now();
  double elapsed_s = 0.0;
  for (int i = 1; i <= problem.periods; ++i) {
    const std::string failure = trial.contender->advance(1);
    elapsed_s = seconds_since(start);
    if (!failure.empty()) {
      trial.row.status = failure;
      return;
    }
    const bool predictable = elapsed_s > least_prediction_s;
    if (predictable && elapsed_s * problem.periods / i > effort.slowest_run_s) {
      trial.row.status = "too slow";
      return;
    }
  }
  trial.count(elapsed_s);
}

void judge(Trial& trial, const SolverComparison& comparison) {
  MeasuredSetting& row = trial.row;
  const long double whole = static_cast<long double>(peers::carrier_period) * comparison.periods;
  const long double reference = comparison.reference.motion.friction_ratio;
  const long double error =
      std::abs(static_cast<long double>(trial.contender->friction_integral()) / whole - reference);
  row.error = static_cast<double>(comparison.absolute_error ? error : error / std::abs(reference));
  row.steps_per_period =
      static_cast<double>(trial.contender->steps()) / static_cast<double>(comparison.periods);
  if (!std::isfinite(row.error)) {
    row.status = "friction ratio not finite";
  }
}

void repeat(Trial& trial, const peers::Problem& problem) {
  trial.contender->restart();
  const Clock::time_point start = Clock::now();
  trial.contender->advance(problem.periods);
  trial.count(seconds_since(start));
}

std::vector<Trial> trials_of(const peers::Problem& problem,
                             const std::vector<ComparedSolver>& solvers) {
  std::vector<Trial> trials;
  for (const ComparedSolver& solver : solvers) {
    for (const double setting : solver.settings) {
      Trial trial;
      trial.row.solver = &solver;
      trial.row.setting = setting;
      trial.contender = solver.make(problem, setting);
      trials.push_back(std::move(trial));
    }
  }
  return trials;
}

}  // namespace

SolverComparison compare(const peers::Problem& problem, const std::vector<ComparedSolver>& solvers,
                         const Effort& effort, const std::function<void(double)>& progress) {
  const auto report = [&progress](double part) {
    if (progress) {
      progress(part);
    }
  };
  report(0.0);
  SolverComparison comparison;
  comparison.periods = problem.periods;
  comparison.reference = checked_reference(problem);
  comparison.absolute_error =
      std::abs(comparison.reference.motion.friction_ratio) < smallest_divisor;

  std::vector<Trial> trials = trials_of(problem, solvers);
  const auto count = static_cast<double>(trials.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    first_run(trials[i], problem, effort);
    if (trials[i].row.ok()) {
      judge(trials[i], comparison);
    }
    report(first_pass_share * static_cast<double>(i + 1) / count);
  }
  for (int round = 0; round < effort.most_repeats; ++round) {
    for (Trial& trial : trials) {
      if (trial.row.ok() && trial.spent_s < effort.repeats_s) {
        repeat(trial, problem);
      }
    }
    report(first_pass_share + (1.0 - first_pass_share) * (round + 1) / effort.most_repeats);
  }
  for (Trial& trial : trials) {
    if (trial.row.ok()) {
      trial.row.wall_us_per_period = 1e6 * trial.shortest_s / problem.periods;
    }
    comparison.rows.push_back(std::move(trial.row));
  }
  return comparison;
}

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
