/// How closely a closed loop held its targets.
#pragma once

#include <cstddef>
#include <optional>

#include "host_sim/loop/period.hpp"
#include "host_sim/report/target_spans.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// Largest |ratio − target| over the carrier periods in which the target can be expected to be met:
/// sliding at or above the speed floor from end to end, and more than ten periods after the target
/// step, the end of calibration or the last period at the actuator's or the slew limit.
class TrackingMeter final : public loop::PeriodSink {
 public:
  /// @param scene  in closed loop
  TrackingMeter(const scene::Scene& scene, double speed_floor_m_per_s);

  void take(const loop::Period& period) override;

  /// Absent where there was no such period.
  std::optional<double> largest_error() const { return largest_; }

 private:
  SpanCursor cursor_;
  double speed_floor_m_per_s_;
  std::size_t span_ = SpanCursor::none;
  int free_periods_ = 0;  ///< since the step, or since something but the speed floor was in the way
  std::optional<double> largest_;
};

}  // namespace sonoglide::report
