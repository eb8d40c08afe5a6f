#include "host_sim/unit/step_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <vector>

#include "host_sim/output/number.hpp"

namespace sonoglide::unit {
namespace {

using Force = std::vector<double>::const_iterator;

struct Level {
  double mean_N;
  double ripple_N;
};

Level level(Force begin, Force end) {
  const auto [lowest, highest] = std::minmax_element(begin, end);
  return {std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin),
          (*highest - *lowest) / 2.0};
}

/// @param progress  of the step, 0 at the level before and 1 at the one after
/// @param steady    steps at its end of which the last level is the mean
StepCourse course_of(const std::vector<double>& progress, std::size_t steady, double step_s) {
  constexpr double band = 0.05;
  const auto time_s = [&](std::vector<double>::const_iterator at) {
    return static_cast<double>(at - progress.begin()) * step_s;
  };
  const auto reaches = [&](double level) {
    return std::find_if(progress.begin(), progress.end(),
                        [level](double each) { return each >= level; });
  };
  const auto high = reaches(0.9);
  const auto outside = std::find_if(progress.rbegin(), progress.rend(),
                                    [](double each) { return std::abs(each - 1.0) > band; });
  StepCourse course;
  if (high != progress.end()) {
    course.rise_s = time_s(high) - time_s(reaches(0.1));
  }
  if (static_cast<std::size_t>(outside - progress.rbegin()) >= steady) {
    course.settling_s = time_s(outside.base());
  }
  course.overshoot = std::max(0.0, *std::max_element(progress.begin(), progress.end()) - 1.0);
  return course;
}

std::string time_text(const std::optional<double>& time_s) {
  return time_s ? output::quantity(*time_s, "s") : "not within the trace";
}

}  // namespace

StepResponse step_response(const RecordedTrace& trace, const UnitScales& scales) {
  const std::vector<double> force_N =
      values_of(trace, scales, link::Quantity::friction_force, &link::TraceRecord::friction_force);
  const auto trigger = force_N.begin() + trace.state.before;
  const auto steady = (force_N.end() - trigger) / 4;
  const Level before = level(force_N.begin(), trigger);
  const Level after = level(force_N.end() - steady, force_N.end());
  StepResponse response{before.mean_N, after.mean_N, std::max(before.ripple_N, after.ripple_N), {}};
  const double step_N = after.mean_N - before.mean_N;
  if (std::abs(step_N) > 2.0 * response.ripple_N) {
    std::vector<double> progress;
    std::transform(trigger, force_N.end(), std::back_inserter(progress),
                   [&](double each_N) { return (each_N - before.mean_N) / step_N; });
    response.course = course_of(progress, static_cast<std::size_t>(steady), scales.step_s());
  }
  return response;
}

std::string text_of(const StepResponse& response) {
  const auto force = [](double force_N) { return output::quantity(force_N, "N"); };
  const std::string levels =
      fmt::format("friction force from {} to {}, ripple {}", force(response.before_N),
                  force(response.after_N), force(response.ripple_N));
  if (!response.course) {
    return levels + ": a step of less than twice its ripple has no course";
  }
  const StepCourse& course = *response.course;
  return fmt::format("{}: rises in {}, within 5 % of the step after {}, overshoot {:.1f} %", levels,
                     time_text(course.rise_s), time_text(course.settling_s),
                     100.0 * course.overshoot);
}

}  // namespace sonoglide::unit
