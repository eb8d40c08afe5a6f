/// A point of a sweep as a row of its table, and as a line of its journal.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/control/interface/drive_command.hpp"

namespace sonoglide::sweep {

/// A figure that is not defined, or of a failed point, is NaN.
struct PointResult {
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

struct Record {
  std::size_t point = 0;
  PointResult row;
};

/// A record as one line. Numbers keep every bit.
std::string record_text(const Record& record);

/// Absent if the text is not that of a record.
std::optional<Record> parse_record(std::string_view text);

}  // namespace sonoglide::sweep
