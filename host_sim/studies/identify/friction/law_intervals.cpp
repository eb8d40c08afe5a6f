#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/friction/comparison.hpp"
#include "host_sim/studies/identify/friction/law_problem.hpp"

namespace sonoglide::identify::friction {
namespace {

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

/// By how much each parameter would be off, were the vibrations larger than stated.
std::string effect_of_scale(const Readings& readings, const LawFit& fit) {
  constexpr double larger = 1.01;
  Readings scaled = readings;
  for (Reading& row : scaled.rows) {
    row.vibration_m_per_s *= larger;
  }
  const LawProblem problem(scaled, fit.law);
  const LawProblem::Solution solution = problem.solve(Scatter(scaled, 0.0, 1.0, 1.0), fit.logs);
  const std::vector<LogInterval> none(static_cast<std::size_t>(fit.logs.size()));
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

}  // namespace sonoglide::identify::friction
