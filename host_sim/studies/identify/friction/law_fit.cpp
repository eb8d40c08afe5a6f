#include "host_sim/studies/identify/friction/comparison.hpp"

#include <fmt/format.h>
#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host_sim/studies/identify/friction/law_problem.hpp"
#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::friction {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Which end of its range a logarithm is at, within a hundredth.
enum class End { none, least, most };
End end_of(const LawProblem::Range& range, double log) {
  constexpr double near = 0.01;
  const double part = (log - range.least) / (range.most - range.least);
  if (part < near) {
    return End::least;
  }
  return part > 1.0 - near ? End::most : End::none;
}

/// Whether the readings leave a parameter open by more than a factor of ten; an end that is open is
/// that of its range.
bool is_open(const ShapeParameter& parameter, const LawProblem::Range& range,
             const LogInterval& interval) {
  constexpr double most = 10.0;
  const auto end = [&](double log, double limit) {
    return parameter.offset + std::exp(std::isnan(log) ? limit : log);
  };
  return end(interval.high, range.most) > most * end(interval.low, range.least);
}

/// @param is_open  see is_open()
std::string open_text(const ShapeParameter& parameter, End end, const LogInterval& interval,
                      bool is_open) {
  const bool low = std::isnan(interval.low);
  const bool high = std::isnan(interval.high);
  std::string text;
  if (end != End::none) {
    return fmt::format("{}: the fit ends at its bound, {}", parameter.name,
                       end == End::least ? parameter.at_least : parameter.at_most);
  }
  if (low || high) {
    text = low && high ? "any value fits"
                       : fmt::format("no {} end of its interval, {}", low ? "lower" : "upper",
                                     low ? parameter.at_least : parameter.at_most);
  }
  if (is_open) {
    text += fmt::format("{}open by more than a factor of ten", text.empty() ? "" : ", ");
  }
  return text.empty() ? text : fmt::format("{}: {}", parameter.name, text);
}

/// Values and ends of the intervals as they are shown.
std::vector<Estimate> estimates(const LawFit& fit, const Readings& readings,
                                const LawProblem& problem,
                                const std::vector<LogInterval>& intervals) {
  std::vector<Estimate> all;
  for (std::size_t i = 0; i < fit.law.shape.size(); ++i) {
    const ShapeParameter& shape = fit.law.shape[i];
    const double log = fit.logs(static_cast<Eigen::Index>(i));
    const bool inside =
        fit.is_determined && end_of(problem.range(static_cast<Eigen::Index>(i)), log) == End::none;
    const auto value = [&](double any) { return shape.offset + std::exp(any); };
    all.push_back({shape.name, inside ? value(log) : unknown, value(intervals[i].low),
                   value(intervals[i].high)});
    if (!shape.also.empty()) {
      const Estimate& one = all.back();
      all.push_back({shape.also, shape.factor * one.value, shape.factor * one.low_95,
                     shape.factor * one.high_95});
    }
  }
  if (readings.are_forces) {
    all.push_back({"friction_limit_N",
                   fit.is_determined ? std::exp(fit.logs(fit.logs.size() - 1)) : unknown,
                   std::exp(intervals.back().low), std::exp(intervals.back().high)});
  }
  return all;
}

/// What a law leaves open.
std::vector<std::string> open_ends(const LawFit& fit, const LawProblem& problem,
                                   const std::vector<LogInterval>& intervals) {
  if (!fit.is_determined) {
    return {fmt::format(
        "{}: {} parameters are not determined by {}; any of many values fit as well.",
        fit.law.title, problem.parameters(),
        fit.different == 1 ? std::string("readings of one velocity")
                           : fmt::format("readings of {} different velocities", fit.different))};
  }
  if (problem.parameters() > 0 && problem.readings() <= problem.parameters()) {
    return {fmt::format(
        "{}: {} parameters from {} readings are no test of the law and have no intervals.",
        fit.law.title, problem.parameters(), problem.readings())};
  }
  std::vector<std::string> all;
  for (std::size_t i = 0; i < fit.law.shape.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const LawProblem::Range& range = problem.range(at);
    const std::string text = open_text(fit.law.shape[i], end_of(range, fit.logs(at)), intervals[i],
                                       is_open(fit.law.shape[i], range, intervals[i]));
    if (!text.empty()) {
      all.push_back(fmt::format("{}, {}.", fit.law.title, text));
    }
  }
  return all;
}

/// A value that is open by more than a factor of ten is none, and what follows from it.
void withhold(LawFit& fit, const LawProblem& problem, const std::vector<LogInterval>& intervals) {
  auto estimate = fit.parameters.begin();
  for (std::size_t i = 0; i < fit.law.shape.size(); ++i) {
    const ShapeParameter& shape = fit.law.shape[i];
    const auto next = estimate + (shape.also.empty() ? 1 : 2);
    if (is_open(shape, problem.range(static_cast<Eigen::Index>(i)), intervals[i])) {
      std::for_each(estimate, next, [](Estimate& each) { each.value = unknown; });
    }
    estimate = next;
  }
}

/// Probabilities of the scatters under a fit.
std::vector<double> probabilities_of(const LawProblem& problem, const LawFit& fit,
                                     const std::vector<Scatter>& scatters) {
  return problem.readings() > problem.parameters()
             ? probabilities(scatters, problem.residuals(fit.logs), problem.jacobian(fit.logs))
             : std::vector<double>(1, 1.0);
}

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
  return sum < most * freedom
             ? boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), sum))
             : 0.0;
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

/// By how much each parameter would be off, were the vibrations larger than stated.
std::string effect_of_scale(const Readings& readings, const LawFit& fit) {
  constexpr double larger = 1.01;
  Readings scaled = readings;
  for (Reading& row : scaled.rows) {
    row.vibration_m_per_s *= larger;
  }
  const LawProblem problem(scaled, fit.law);
  const LawProblem::Solution solution = problem.solve(Scatter(scaled, 0.0, 1.0, 1.0), fit.logs);
  const std::vector<LogInterval> none(static_cast<std::size_t>(fit.logs.size()),
                                      {unknown, unknown});
  LawFit other = fit;
  other.logs = solution.logs;
  const std::vector<Estimate> moved = estimates(other, readings, problem, none);
  std::string effects;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const double percent = 100.0 * (moved[i].value / fit.parameters[i].value - 1.0);
    constexpr double least = 0.05;
    if (std::abs(percent) >= least) {
      effects +=
          fmt::format("{}{} {:.2g} % {}", effects.empty() ? "" : ", ", fit.parameters[i].name,
                      std::abs(percent), percent > 0.0 ? "larger" : "smaller");
    }
  }
  return effects.empty()
             ? std::string()
             : fmt::format(
                   "{}: the intervals hold no error of the vibration's scale, which all readings "
                   "share. Were the vibrations 1 % larger than stated: {}.",
                   fit.law.title, effects);
}

}  // namespace

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
  fit.parameters = estimates(
      fit, readings, problem,
      std::vector<LogInterval>(static_cast<std::size_t>(problem.parameters()), {unknown, unknown}));
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
  const bool is_exact = fit.residual_rms <= law.accuracy;
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

void add_intervals(const Readings& readings, LawFit& fit) {
  const LawProblem problem(readings, fit.law);
  const std::vector<Scatter> all = scatters(readings);
  std::vector<LogInterval> ends =
      intervals(problem, fit.logs, all, probabilities_of(problem, fit, all));
  for (std::size_t i = 0; i < ends.size(); ++i) {
    // The value is the best for white scatter, which may lie beyond the mixture's interval.
    const double log = fit.logs(static_cast<Eigen::Index>(i));
    ends[i].low = ends[i].low > log ? log : ends[i].low;
    ends[i].high = ends[i].high < log ? log : ends[i].high;
  }
  fit.parameters = estimates(fit, readings, problem, ends);
  fit.open = open_ends(fit, problem, ends);
  if (problem.is_determined() && problem.readings() > problem.parameters()) {
    withhold(fit, problem, ends);
  }
  if (const std::string effect = effect_of_scale(readings, fit);
      fit.is_determined && !effect.empty()) {
    fit.open.push_back(effect);
  }
}

double friction_of(const Readings& readings, const LawFit& fit, const Reading& row) {
  return LawProblem(readings, fit.law).friction(row, fit.logs);
}

}  // namespace sonoglide::identify::friction
