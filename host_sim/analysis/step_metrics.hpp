/// How well a closed loop followed its target.
#pragma once

#include <optional>
#include <vector>

#include "firmware/control/drive_command.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::analysis {

/// One target step. "Steady" means the last quarter of the step, or of what calibration leaves of
/// it. A figure for which there is no carrier period is NaN.
struct StepMetrics {
  double time_s = 0.0;
  double target = 0.0;
  /// From the later of the step's time and the end of calibration until the per-period ratio is
  /// inside target ± band for the rest of the step; absent if it never is.
  std::optional<double> settling_time_s;
  double overshoot =
      0.0;  ///< farthest beyond the target, seen from where the ratio came from; >= 0
  double steady_error = 0.0;       ///< mean ratio − target
  double ripple = 0.0;             ///< half peak-to-peak of the per-period ratio
  double drive_amplitude_N = 0.0;  ///< mean
  control::Limit limit =
      control::Limit::none;  ///< the most frequent one of the steady part; none if none was
};

/// Metrics of every target step that begins before the run ends.
std::vector<StepMetrics> step_metrics(const scene::Scene& scene, const loop::RunResult& result);

/// Largest |ratio − target| over the carrier periods in which the target can be expected to be met:
/// sliding at or above the speed floor from end to end, and more than ten periods after the target
/// step, the end of calibration or the last period at the actuator's or the slew limit. Absent
/// where there is no such period.
std::optional<double> largest_tracking_error(const scene::Scene& scene,
                                             const loop::RunResult& result);

}  // namespace sonoglide::analysis
