#include "host_sim/studies/stability/study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host_sim/studies/stability/random_scene.hpp"
#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability {
namespace {

constexpr std::size_t batch = 500;
constexpr std::size_t worst_kept = 5;

double allowed_residual(const TriedPrecision& precision) {
  return precision.name == "float64" ? allowed_residual_float64 : allowed_residual_float32;
}

/// What cannot be evaluated, because the energy overflows, is as wrong as can be.
double comparable_residual(const TrialResult& result) {
  return std::isnan(result.balance_residual) ? std::numeric_limits<double>::infinity()
                                             : result.balance_residual;
}

WorstCase run_one(const TriedPrecision& precision, std::uint64_t scene) {
  TrialResult result = precision.trial(
      random_scene(scene), {random_scene_periods, precision.extreme_setting, extreme_step_limit});
  result.balance_residual = comparable_residual(result);
  const Verdict verdict =
      judge(result, result.balance_residual, allowed_residual(precision), precision.friction_bound);
  return {scene, verdict, result};
}

bool handed_over(const WorstCase& run) {
  return run.result.supported && run.result.error == plant::Error::none;
}

bool is_silent(Verdict verdict) {
  return verdict == Verdict::silent_friction_bound || verdict == Verdict::silent_not_finite;
}

bool is_worse(const WorstCase& a, const WorstCase& b) {
  if (is_silent(a.verdict) != is_silent(b.verdict)) {
    return is_silent(a.verdict);
  }
  if (a.result.balance_residual != b.result.balance_residual) {
    return a.result.balance_residual > b.result.balance_residual;
  }
  return a.scene < b.scene;
}

void summarise(std::vector<WorstCase> runs, ExtremeRow& row) {
  for (const WorstCase& run : runs) {
    ++row.count[static_cast<std::size_t>(run.verdict)];
  }
  runs.erase(std::remove_if(runs.begin(), runs.end(),
                            [](const WorstCase& run) { return !handed_over(run); }),
             runs.end());
  if (runs.empty()) {
    return;
  }
  std::sort(runs.begin(), runs.end(), is_worse);
  row.worst.assign(runs.begin(),
                   runs.begin() + static_cast<std::ptrdiff_t>(std::min(worst_kept, runs.size())));
  std::vector<double> residuals;
  residuals.reserve(runs.size());
  for (const WorstCase& run : runs) {
    residuals.push_back(run.result.balance_residual);
  }
  std::sort(residuals.begin(), residuals.end());
  for (std::size_t i = 0; i < residual_quantiles.size(); ++i) {
    const double rank = std::ceil(residual_quantiles[i] * static_cast<double>(residuals.size()));
    row.residual[i] = residuals[static_cast<std::size_t>(rank) - 1];
  }
}

}  // namespace

Extremes extremes(std::uint64_t count, const Progress& progress) {
  Extremes result{count, {}};
  const double row_count = static_cast<double>(2 * solvers().size());
  for (const TriedSolver& solver : solvers()) {
    for (const TriedPrecision& precision : solver.precisions) {
      const double begun = static_cast<double>(result.rows.size());
      std::vector<WorstCase> runs(count);
      for_each_index(
          count, batch, [&](double part) { progress((begun + part) / row_count); },
          [&](std::size_t i) { runs[i] = run_one(precision, i); });
      ExtremeRow row;
      row.solver = solver.name;
      row.precision = precision.name;
      row.setting = precision.extreme_setting;
      summarise(std::move(runs), row);
      result.rows.push_back(std::move(row));
    }
  }
  return result;
}

}  // namespace sonoglide::stability
