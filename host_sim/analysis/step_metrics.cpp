#include "host_sim/analysis/step_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sonoglide::analysis {
namespace {

using loop::Period;

/// The part of a run that belongs to one target.
struct Span {
  double begin_s;    ///< the later of the step's time and the end of calibration
  double quarter_s;  ///< where the step's last quarter begins
  double end_s;
  double target;
  double previous;  ///< target, or undriven ratio, before
};

std::vector<Span> spans(const scene::Scene& scene) {
  const scene::Controller& controller = *scene.controller;
  const auto& steps = controller.target_friction_ratio;
  std::vector<Span> result;
  double previous = 1.0;
  for (std::size_t i = 0; i < steps.size() && steps[i].time_s < scene.run.duration_s; ++i) {
    const double next_s = i + 1 < steps.size() ? steps[i + 1].time_s : scene.run.duration_s;
    const double end_s = std::min(next_s, scene.run.duration_s);
    const double begin_s = std::max(steps[i].time_s, controller.calibration_s);
    const double quarter_s = end_s - 0.25 * (end_s - steps[i].time_s);
    // A calibration that reaches into the last quarter leaves less than one.
    result.push_back({begin_s, begin_s <= quarter_s ? quarter_s : end_s - 0.25 * (end_s - begin_s),
                      end_s, steps[i].friction_ratio, previous});
    if (begin_s < end_s) {  // else calibration has swallowed the step
      previous = steps[i].friction_ratio;
    }
  }
  return result;
}

/// Whole carrier periods only: a mean over part of one is no friction ratio.
std::vector<Period> periods_in(const scene::Scene& scene, const loop::RunResult& result,
                               double begin_s, double end_s) {
  const double period_s = 1.0 / scene.drive->frequency_Hz;
  const double rounding_s = 1e-6 * period_s;
  std::vector<Period> found;
  std::copy_if(result.periods.begin(), result.periods.end(), std::back_inserter(found),
               [=](const Period& period) {
                 return period.begin_s >= begin_s - rounding_s &&
                        period.end_s <= end_s + rounding_s &&
                        period.end_s - period.begin_s >= period_s - rounding_s;
               });
  return found;
}

std::optional<double> settling_time(const std::vector<Period>& periods, const Span& span,
                                    double band) {
  double settled_s = span.begin_s;
  for (const Period& period : periods) {
    if (!(std::abs(period.friction_ratio - span.target) <= band)) {
      settled_s = period.end_s;
    }
  }
  if (periods.empty() || settled_s >= periods.back().end_s) {
    return std::nullopt;
  }
  return settled_s - span.begin_s;
}

double overshoot(const std::vector<Period>& periods, const Span& span) {
  const double direction = span.target < span.previous ? -1.0 : 1.0;
  double farthest = periods.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  for (const Period& period : periods) {
    if (period.target == span.target) {  // else still driven for the target before
      farthest = std::max(farthest, direction * (period.friction_ratio - span.target));
    }
  }
  return farthest;
}

control::Limit prevailing_limit(const std::vector<Period>& periods) {
  constexpr std::size_t limits = 4;
  std::array<std::size_t, limits> count{};
  for (const Period& period : periods) {
    ++count[static_cast<std::size_t>(period.limit)];
  }
  count[0] = 0;
  const auto most = std::max_element(count.begin(), count.end());
  return *most == 0 ? control::Limit::none
                    : static_cast<control::Limit>(std::distance(count.begin(), most));
}

StepMetrics metrics(const scene::Scene& scene, const loop::RunResult& result, const Span& span,
                    double step_time_s) {
  const std::vector<Period> whole = periods_in(scene, result, span.begin_s, span.end_s);
  const std::vector<Period> steady =
      periods_in(scene, result, std::max(span.quarter_s, span.begin_s), span.end_s);
  double sum = 0.0;
  double drive_sum_N = 0.0;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const Period& period : steady) {
    sum += period.friction_ratio;
    drive_sum_N += period.drive_amplitude_N;
    lowest = std::min(lowest, period.friction_ratio);
    highest = std::max(highest, period.friction_ratio);
  }
  const auto count = static_cast<double>(steady.size());  // none: the means are NaN
  return {step_time_s,
          span.target,
          settling_time(whole, span, scene.run.settling_band),
          overshoot(whole, span),
          sum / count - span.target,
          steady.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.5 * (highest - lowest),
          drive_sum_N / count,
          prevailing_limit(steady)};
}

}  // namespace

std::vector<StepMetrics> step_metrics(const scene::Scene& scene, const loop::RunResult& result) {
  std::vector<StepMetrics> all;
  const std::vector<Span> steps = spans(scene);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    all.push_back(
        metrics(scene, result, steps[i], scene.controller->target_friction_ratio[i].time_s));
  }
  return all;
}

std::optional<double> largest_tracking_error(const scene::Scene& scene,
                                             const loop::RunResult& result) {
  constexpr int settling_periods = 10;
  const scene::ControlDesign& design = result.control->design;
  const double floor_m_per_s = design.speed_floor * design.scales.velocity_m_per_s;
  std::optional<double> largest;
  for (const Span& span : spans(scene)) {
    int free_periods = 0;  // since the step, or since something but the speed floor was in the way
    for (const Period& period : periods_in(scene, result, span.begin_s, span.end_s)) {
      const bool driven =
          period.state == control::State::running || period.state == control::State::limited;
      const bool limited =
          period.limit == control::Limit::actuator || period.limit == control::Limit::slew;
      const double slowest =
          std::min(std::abs(period.begin_velocity_m_per_s), std::abs(period.end_velocity_m_per_s));
      if (!driven || limited) {
        free_periods = 0;
      } else if (++free_periods > settling_periods && slowest >= floor_m_per_s) {
        largest = std::max(largest.value_or(0.0), std::abs(period.friction_ratio - span.target));
      }
    }
  }
  return largest;
}

}  // namespace sonoglide::analysis
