#include "host_sim/report/step_metrics.hpp"

#include <algorithm>
#include <limits>

namespace sonoglide::report {

TargetUnit target_unit(const scene::Scene& scene) {
  return scene.controller && scene.controller->holds_force()
             ? TargetUnit{"N", "_N", scene.friction.limit_N()}
             : TargetUnit{"", "", 1.0};
}

std::vector<TargetSpan> target_spans(const scene::Scene& scene) {
  const scene::Controller& controller = *scene.controller;
  const auto& steps = controller.targets();
  const TargetUnit unit = target_unit(scene);
  std::vector<TargetSpan> spans;
  double previous = unit.is_force() ? std::numeric_limits<double>::infinity() : 1.0;
  for (std::size_t i = 0; i < steps.size() && steps[i].time_s < scene.run.duration_s; ++i) {
    const double next_s = i + 1 < steps.size() ? steps[i + 1].time_s : scene.run.duration_s;
    const double end_s = std::min(next_s, scene.run.duration_s);
    const double begin_s = std::max(steps[i].time_s, controller.calibration_s.value_or(0.0));
    const double quarter_s = end_s - 0.25 * (end_s - steps[i].time_s);
    // A calibration that reaches into the last quarter leaves less than one.
    spans.push_back({steps[i].time_s, begin_s,
                     begin_s <= quarter_s ? quarter_s : end_s - 0.25 * (end_s - begin_s), end_s,
                     steps[i].value / unit.size, previous});
    if (begin_s < end_s) {  // else calibration has swallowed the step
      previous = steps[i].value / unit.size;
    }
  }
  return spans;
}

SpanCursor::SpanCursor(const scene::Scene& scene)
    : spans_(target_spans(scene)), rounding_s_(1e-6 / scene.drive->frequency_Hz) {}

std::size_t SpanCursor::span_of(const loop::Period& period) {
  while (current_ < spans_.size() && spans_[current_].end_s + rounding_s_ < period.end_s) {
    ++current_;
  }
  if (current_ == spans_.size() || period.begin_s < spans_[current_].begin_s - rounding_s_ ||
      !period.whole) {
    return none;
  }
  return current_;
}

bool SpanCursor::in_last_quarter(const loop::Period& period, const TargetSpan& span) const {
  return period.begin_s >= std::max(span.quarter_s, span.begin_s) - rounding_s_;
}

}  // namespace sonoglide::report
