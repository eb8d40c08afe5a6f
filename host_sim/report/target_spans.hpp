/// Which target a carrier period belongs to.
#pragma once

#include <cstddef>
#include <vector>

#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// The part of a run that belongs to one target.
struct TargetSpan {
  double step_s;     ///< when the target is set
  double begin_s;    ///< the later of that and the end of calibration
  double quarter_s;  ///< where the last quarter begins
  double end_s;
  double target;
  double previous;  ///< target, or undriven ratio, before
};

/// The spans of every target step that begins before the run ends, known before it begins.
std::vector<TargetSpan> target_spans(const scene::Scene& scene);

/// Goes along the spans with the carrier periods of a run.
class SpanCursor {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  explicit SpanCursor(const scene::Scene& scene);

  const std::vector<TargetSpan>& spans() const { return spans_; }

  /// Index of the span that holds the period from end to end; none where there is none, or where
  /// the run cuts the period short: a mean over part of one is no friction ratio.
  /// @param period  not before the one of the last call
  std::size_t span_of(const loop::Period& period);

  /// Whether the period lies in the last quarter of a span that holds it.
  bool in_last_quarter(const loop::Period& period, const TargetSpan& span) const;

 private:
  std::vector<TargetSpan> spans_;
  double rounding_s_;
  std::size_t current_ = 0;
};

}  // namespace sonoglide::report
