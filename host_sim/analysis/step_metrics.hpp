/// How well a closed loop followed each step of its target.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "firmware/control/drive_command.hpp"
#include "host_sim/analysis/target_spans.hpp"
#include "host_sim/loop/period.hpp"
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

/// Measures every target step that begins before the run ends, from its carrier periods as they
/// come.
class StepMeter final : public loop::PeriodSink {
 public:
  /// @param scene  in closed loop
  explicit StepMeter(const scene::Scene& scene);

  void take(const loop::Period& period) override;

  /// One entry for each step; to be asked after the run.
  std::vector<StepMetrics> steps() const;

 private:
  static constexpr std::size_t limits = 4;

  struct Tally {
    double settled_s = 0.0;   ///< end of the last period outside the band
    double last_end_s = 0.0;  ///< of the last period
    double overshoot = 0.0;
    std::uint64_t periods = 0;
    // Of the steady part:
    std::uint64_t steady_periods = 0;
    double ratio_sum = 0.0;
    double drive_sum_N = 0.0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();
    std::array<std::uint64_t, limits> limit_count{};
  };

  void take_any(const loop::Period& period, const TargetSpan& span, Tally& tally) const;
  static void take_steady(const loop::Period& period, Tally& tally);
  static StepMetrics metrics(const TargetSpan& span, const Tally& tally);

  SpanCursor cursor_;
  double band_;
  std::vector<Tally> tallies_;
};

}  // namespace sonoglide::analysis
