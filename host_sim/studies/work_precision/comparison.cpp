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

}  // namespace sonoglide::work_precision
