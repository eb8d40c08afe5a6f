#include "host_sim/boards/unit/step_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <vector>

#include "host_sim/boards/unit/stream_table.hpp"
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

constexpr double band = 0.05;  // of the step

/// @param progress  of the step, 0 at the level before and 1 at the one after
/// @param steady    steps at its end of which the last level is the mean
StepCourse course_of(const std::vector<double>& progress, std::size_t steady, double step_s) {
  const auto time_s = [&](std::vector<double>::const_iterator at) {
    return static_cast<double>(at - progress.begin()) * step_s;
  };
  const auto reaches = [&](double level) {
    return std::find_if(progress.begin(), progress.end(),
                        [level](double each) { return each >= level; });
  };
  const auto outside = std::find_if(progress.rbegin(), progress.rend(),
                                    [](double each) { return std::abs(each - 1.0) > band; });
  StepCourse course;
  course.rise_s = time_s(reaches(0.9)) - time_s(reaches(0.1));
  if (static_cast<std::size_t>(outside - progress.rbegin()) >= steady) {
    course.settling_s = time_s(outside.base());
  }
  course.overshoot = std::max(0.0, *std::max_element(progress.begin(), progress.end()) - 1.0);
  return course;
}

}  // namespace

StepResponse step_response(const RecordedStep& step, const UnitScales& scales) {
  const RecordedTrace& trace = step.trace;
  const std::vector<double> force_N =
      values_of(trace, scales, link::Quantity::friction_force, &link::TraceRecord::friction_force);
  const auto trigger = force_N.begin() + trace.state.before;
  const auto steady = (force_N.end() - trigger) / 4;
  const Level before = level(force_N.begin(), trigger);
  const Level after = level(force_N.end() - steady, force_N.end());
  StepResponse response{before.mean_N,
                        after.mean_N,
                        std::max(before.ripple_N, after.ripple_N),
                        {},
                        step.settled_before,
                        trace.records.back().codes};
  const double step_N = after.mean_N - before.mean_N;
  const double code_N = scales.value_of(link::Quantity::friction_force, 1);
  if (std::max(response.ripple_N, code_N) < band * std::abs(step_N)) {
    std::vector<double> progress;
    std::transform(trigger, force_N.end(), std::back_inserter(progress),
                   [&](double each_N) { return (each_N - before.mean_N) / step_N; });
    response.course = course_of(progress, static_cast<std::size_t>(steady), scales.step_s());
  }
  return response;
}

namespace {

std::string course_text(const StepCourse& course) {
  const std::string settling = course.settling_s
                                   ? fmt::format("within 5 % of the step after {}",
                                                 output::quantity(*course.settling_s, "s"))
                                   : "not within 5 % of the step before the trace ends";
  return fmt::format("10 to 90 % in {}, {}, overshoot {:.1f} %",
                     output::quantity(course.rise_s, "s"), settling, 100.0 * course.overshoot);
}

/// What the controller says of its loop before and at the end, where that is not that it has settled.
std::string remarks(const StepResponse& response) {
  const auto [state, limit, fault, settling] = names_of_codes(response.end_codes);
  std::string text = response.settled_before ? "" : "; the loop had not settled before";
  if (limit != "none" || settling != "settled") {
    text +=
        fmt::format("; at its end the loop is {}, limit {}, settling {}", state, limit, settling);
  }
  return text;
}

}  // namespace

std::string text_of(const StepResponse& response) {
  const auto force = [](double force_N) { return output::quantity(force_N, "N"); };
  if (!response.course && force(response.before_N) == force(response.after_N)) {
    return fmt::format("the friction force stays at {}, ripple {}{}", force(response.after_N),
                       force(response.ripple_N), remarks(response));
  }
  return fmt::format("the friction force goes from {} to {}, ripple {}{}{}",
                     force(response.before_N), force(response.after_N), force(response.ripple_N),
                     response.course ? "; " + course_text(*response.course)
                                     : ", which hides the course of this step",
                     remarks(response));
}

}  // namespace sonoglide::unit
