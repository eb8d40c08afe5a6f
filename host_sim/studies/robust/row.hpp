/// A plant of a robustness study as a row of its table, and as a line of its journal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
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

  bool computed() const { return status == "ok"; }
  /// Something has switched the drive off, a step never settles, or the loop could not be computed.
  bool failed() const { return !computed() || faults != 0 || unsettled != 0; }
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
struct Record {
  std::size_t place = 0;
  PlantRow row;
};

/// A record as one line. Numbers keep every bit.
std::string record_text(const Record& record);

/// Absent if the text is not that of a record.
std::optional<Record> parse_record(std::string_view text);

}  // namespace sonoglide::robust
