/// A point of a sweep as a row of its table, and as a line of its journal.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <tuple>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/long_work/record.hpp"

namespace sonoglide::sweep {

/// A figure that is not defined, or of a failed point, is NaN.
struct PointResult {
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

  std::string status = "ok";  ///< or why the point could not be computed, one line
  double friction_ratio_whole_run = undefined;
  double friction_ratio_window = undefined;
  double dissipation_ratio_window = undefined;  ///< φ_fu
  // Of a load, at the end.
  double load_final_velocity_m_per_s = undefined;
  double load_final_displacement_m = undefined;
  // Closed loop, of the last target step; see report::StepMetrics.
  double settling_time_s = undefined;  ///< NaN also if it never settles
  double steady_error = undefined;     ///< of a target force [N]
  double ripple = undefined;           ///< likewise
  control::Limit limit = control::Limit::none;
  // Of a texture, in place of these; NaN also where no whole period of it counts, see report::TextureMeter.
  double texture_mean_error = undefined;        ///< of target forces [N]
  double texture_amplitude_ratio = undefined;   ///< of its largest harmonic, rendered over wanted
  double texture_lag_deg = undefined;           ///< likewise
  control::Fault fault = control::Fault::none;  ///< the first of the run

  static constexpr auto kept =
      std::tuple(&PointResult::friction_ratio_whole_run, &PointResult::friction_ratio_window,
                 &PointResult::dissipation_ratio_window, &PointResult::load_final_velocity_m_per_s,
                 &PointResult::load_final_displacement_m, &PointResult::settling_time_s,
                 &PointResult::steady_error, &PointResult::ripple, &PointResult::limit,
                 &PointResult::texture_mean_error, &PointResult::texture_amplitude_ratio,
                 &PointResult::texture_lag_deg, &PointResult::fault);
  bool plausible() const {
    return static_cast<std::size_t>(limit) < control::limit_count &&
           fault <= control::Fault::velocity_stuck;
  }

  bool ok() const { return status == "ok"; }
};

using Record = long_work::Record<PointResult>;

}  // namespace sonoglide::sweep
