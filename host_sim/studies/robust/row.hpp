/// A plant of a robustness study as a row of its table, and as a line of its journal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/long_work/record.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/report/step_metrics.hpp"

namespace sonoglide::robust {

/// How the loop did on one plant: of each figure the worst of its target steps. A figure that is not
/// defined is NaN.
struct PlantRow {
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

  std::string status = "ok";           ///< or why the loop could not be computed, one line
  double settling_time_s = undefined;  ///< NaN also where a step never settles
  double overshoot = undefined;
  double steady_error = undefined;  ///< magnitude
  double ripple = undefined;
  double deviation = undefined;  ///< |steady error| + ripple of one step
  std::uint64_t unsettled = 0;   ///< steps that never settle
  std::uint64_t limits = 0;      ///< bit n: control::Limit n is named of a step
  std::uint64_t faults = 0;      ///< bit n: control::Fault n has come
  std::uint64_t trace_hash = 0;  ///< of every drive command

  static constexpr auto kept =
      std::tuple(&PlantRow::settling_time_s, &PlantRow::overshoot, &PlantRow::steady_error,
                 &PlantRow::ripple, &PlantRow::deviation, &PlantRow::unsettled, &PlantRow::limits,
                 &PlantRow::faults, &PlantRow::trace_hash);
  bool plausible() const;

  bool ok() const { return status == "ok"; }
  /// Something has switched the drive off, a step never settles, or the loop could not be computed.
  bool failed() const { return !ok() || faults != 0 || unsettled != 0; }
  /// Grows with the deviation; of a failed plant it is above that of every other, of one that could
  /// not be computed highest.
  double badness() const;
};

PlantRow row_of(const std::vector<report::StepMetrics>& steps, const loop::ControlRecord& control);

/// A loop that could not be computed.
PlantRow failed_row(const std::string& reason);

std::vector<std::string> limit_names(const PlantRow& row);
std::vector<std::string> fault_names(const PlantRow& row);

/// Samples first, then the runs of the search.
using Record = long_work::Record<PlantRow>;

}  // namespace sonoglide::robust
