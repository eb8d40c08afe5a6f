#include "host_sim/studies/arithmetic/precision.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sonoglide::arithmetic {
namespace {

void compare_ratios(const std::vector<double>& ratios, const std::vector<double>& exact,
                    Precision& result) {
  double squares = 0.0;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const double difference = std::abs(ratios[i] - exact[i]);
    squares += difference * difference;
    result.largest_difference = std::max(result.largest_difference, difference);
  }
  result.rms_difference = std::sqrt(squares / static_cast<double>(ratios.size()));
}

void judge_steps(const std::vector<report::StepMetrics>& steps, Precision& result) {
  result.steady_error = std::numeric_limits<double>::quiet_NaN();
  result.ripple = std::numeric_limits<double>::quiet_NaN();
  for (const report::StepMetrics& step : steps) {
    if (step.limit == control::Limit::none) {
      result.steady_error = std::fmax(result.steady_error, std::abs(step.steady_error));
      result.ripple = std::fmax(result.ripple, step.ripple);
    }
  }
}

}  // namespace

Precision precision(const Course& course, const Course& exact) {
  Precision result;
  compare_ratios(course.friction_ratios(), exact.friction_ratios(), result);
  judge_steps(course.steps(), result);
  return result;
}

}  // namespace sonoglide::arithmetic
