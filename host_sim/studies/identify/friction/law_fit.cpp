#include "host_sim/studies/identify/friction/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host_sim/studies/identify/distributions.hpp"
#include "host_sim/studies/identify/friction/law_problem.hpp"

namespace sonoglide::identify::friction {
namespace {

double autocorrelation(const std::vector<double>& residuals) {
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    squares += residuals[i] * residuals[i];
    products += i > 0 ? residuals[i] * residuals[i - 1] : 0.0;
  }
  return squares > 0.0 ? products / squares : unknown;
}

double chi_square_probability(const Readings& readings, const LawFit& fit) {
  const auto freedom =
      static_cast<double>(readings.rows.size()) - static_cast<double>(fit.parameter_count());
  if (!readings.have_standard_errors || freedom <= 0.0) {
    return unknown;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < fit.residuals.size(); ++i) {
    const double part = fit.residuals[i] / readings.rows[i].standard_error;
    sum += part * part;
  }
  constexpr double most = 1e6;
  return sum < most * freedom ? chi_squared_above(freedom, sum) : 0.0;
}

/// Part of the residuals' variance that is misfit; 0 where none is more likely than some.
double misfit_part(const std::vector<Scatter>& scatters, const std::vector<double>& probabilities) {
  constexpr double even = 0.5;
  if (probabilities.front() > even) {
    return 0.0;
  }
  double part = 0.0;
  for (std::size_t i = 0; i < scatters.size(); ++i) {
    part += probabilities[i] * scatters[i].share() / (1.0 + scatters[i].share());
  }
  return part;
}

/// Readings from which a law with one shape parameter has a criterion. With fewer only laws without
/// one would, and they would win.
std::size_t least_compared(const Readings& readings) {
  return readings.are_forces ? 5 : 4;
}

}  // namespace

std::vector<double> probabilities_of(const LawProblem& problem, const LawFit& fit,
                                     const std::vector<Scatter>& scatters) {
  return problem.readings() > problem.parameters()
             ? probabilities(scatters, problem.residuals(fit.logs), problem.jacobian(fit.logs))
             : std::vector<double>(1, 1.0);
}

bool LawFit::exceeds_standard_errors() const {
  return chi_square_probability < fails_below;
}

bool LawFit::fails() const {
  return exceeds_standard_errors() || runs_probability < fails_below;
}

double runs_probability(const std::vector<double>& residuals) {
  int signs[2] = {0, 0};
  int runs = 0;
  int last = -1;
  for (const double each : residuals) {
    const int sign = each < 0.0 ? 1 : 0;
    ++signs[sign];
    runs += sign == last ? 0 : 1;
    last = sign;
  }
  const int ups = signs[0];
  const int downs = signs[1];
  if (ups == 0 || downs == 0) {
    // All of one sign has no arrangement to compare with; as likely as heads alone.
    return std::pow(0.5, static_cast<double>(residuals.size()) - 1.0);
  }
  const auto log_choose = [](int n, int k) {
    return k < 0 || k > n ? -std::numeric_limits<double>::infinity()
                          : std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0);
  };
  const double all = log_choose(ups + downs, ups);
  double sum = 0.0;
  for (int count = 2; count <= runs; ++count) {
    const int half = count / 2;
    const auto ways = [&](int of_ups, int of_downs) {
      return std::exp(log_choose(ups - 1, of_ups - 1) + log_choose(downs - 1, of_downs - 1) - all);
    };
    sum += count % 2 == 0 ? 2.0 * ways(half, half) : ways(half + 1, half) + ways(half, half + 1);
  }
  return std::min(sum, 1.0);
}

LawFit fit(const Readings& readings, const Candidate& law) {
  const LawProblem problem(readings, law);
  const LawProblem::Solution best = problem.solve();
  LawFit fit;
  fit.law = law;
  fit.logs = best.logs;
  fit.different = readings.distinct();
  fit.is_determined = problem.is_determined();
  fit.parameters =
      estimates(fit, readings, problem,
                std::vector<LogInterval>(static_cast<std::size_t>(problem.parameters())));
  const Eigen::VectorXd fitted = problem.friction(best.logs);
  double squares = 0.0;
  for (std::size_t i = 0; i < readings.rows.size(); ++i) {
    fit.residuals.push_back(readings.rows[i].friction - fitted(static_cast<Eigen::Index>(i)));
    squares += fit.residuals.back() * fit.residuals.back();
  }
  const auto n = static_cast<double>(readings.rows.size());
  const double limit = readings.are_forces ? std::exp(best.logs(best.logs.size() - 1)) : 1.0;
  fit.residual_rms = std::sqrt(squares / n) / limit;
  const std::vector<Scatter> all = scatters(readings);
  // Rounding of a smooth curve has a pattern too; at a single velocity all may be off by half a digit.
  constexpr double little_more = 1.2;
  const double off = readings.last_digit * (fit.different == 1 ? 0.5 : 1.0 / std::sqrt(12.0));
  const bool is_exact = fit.residual_rms <= std::max(law.accuracy, little_more * off / limit);
  fit.misfit = is_exact ? 0.0
                        : fit.residual_rms *
                              std::sqrt(misfit_part(all, probabilities_of(problem, fit, all)));
  // Residuals of rounding alone do not compare laws.
  constexpr double rounding = 1e-9;
  const double least = n * rounding * rounding * limit * limit;
  fit.akaike = readings.rows.size() < least_compared(readings) || !fit.is_determined
                   ? std::numeric_limits<double>::infinity()
                   : corrected_akaike(std::max(best.sum_of_squares, least), problem.readings(),
                                      problem.parameters());
  fit.runs_probability = is_exact ? 1.0 : runs_probability(fit.residuals);
  fit.autocorrelation = autocorrelation(fit.residuals);
  fit.chi_square_probability = chi_square_probability(readings, fit);
  return fit;
}

double friction_of(const Readings& readings, const LawFit& fit, const Reading& row) {
  return LawProblem(readings, fit.law).friction(row, fit.logs);
}

}  // namespace sonoglide::identify::friction
