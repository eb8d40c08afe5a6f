/// What one point of a sweep came to.
#pragma once

#include <limits>
#include <string>

#include "firmware/control/drive_command.hpp"

namespace sonoglide::sweep {

/// A figure that is not defined, or of a failed point, is NaN.
struct Row {
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

  std::string status = "ok";  ///< or why the point could not be computed, one line
  double friction_ratio_whole_run = undefined;
  double friction_ratio_window = undefined;
  double dissipation_ratio_window = undefined;  ///< φ_fu
  // Closed loop, of the last target step; see report::StepMetrics.
  double settling_time_s = undefined;  ///< NaN also if it never settles
  double steady_error = undefined;
  double ripple = undefined;
  control::Limit limit = control::Limit::none;
  control::Fault fault = control::Fault::none;  ///< the first of the run

  bool ok() const { return status == "ok"; }
};

}  // namespace sonoglide::sweep
