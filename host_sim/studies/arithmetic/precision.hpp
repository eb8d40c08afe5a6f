/// How far the arithmetic of a controller takes a closed loop from where float64 takes it.
#pragma once

#include <string>
#include <vector>

#include "host_sim/loop/run.hpp"
#include "host_sim/report/step_metrics.hpp"

namespace sonoglide::arithmetic {

/// The course of one closed-loop run; to be watched with.
class Course final : public loop::PeriodSink {
 public:
  explicit Course(const scene::Scene& scene) : meter_(scene) {}

  void take(const loop::Period& period) override {
    friction_ratios_.push_back(period.friction_ratio);
    meter_.take(period);
  }

  /// One for each carrier period.
  const std::vector<double>& friction_ratios() const { return friction_ratios_; }
  std::vector<report::StepMetrics> steps() const { return meter_.steps(); }

 private:
  std::vector<double> friction_ratios_;
  report::StepMeter meter_;
};

/// A figure for which there is no target step is NaN.
struct Precision {
  double rms_difference = 0.0;  ///< of the friction ratio from that with float64, all periods
  double largest_difference = 0.0;
  double steady_error = 0.0;  ///< largest magnitude over the target steps that no limit disturbed
  double ripple = 0.0;        ///< largest over the same
};

/// @param exact  the same scene with a controller in float64
Precision precision(const Course& course, const Course& exact);

}  // namespace sonoglide::arithmetic
