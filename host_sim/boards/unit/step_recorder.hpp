/// How the steps of a running unit are recorded.
#pragma once

#include <chrono>
#include <cstdint>

#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/boards/unit/unit_refusal.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"
#include "host_sim/boards/unit/unit_trace.hpp"

namespace sonoglide::unit {

struct RecordedStep {
  RecordedTrace trace;
  bool settled_before = false;  ///< the loop, at the first target
};

/// Drives a unit from target to target and reads its traces. It keeps its limits and finds its faults as ever.
/// Every function throws process::ProcessError where the unit does not answer, and UnitRefusal.
class StepRecorder {
 public:
  /// @param unit, scales  outlive this
  StepRecorder(UnitLink& unit, const UnitScales& scales) : unit_(unit), scales_(scales) {}

  /// The unit without a drive: it is stopped.
  RecordedTrace undriven();

  void restart();

  /// Waits until the loop tells whether it settles, 5 s at most, and then until its natural mode is calm.
  /// @return whether it has settled
  bool settle();

  /// Sets a target. @param target  count of millionths
  void set_target(std::uint32_t target);

  /// The steps around a new target.
  /// @param target  count of millionths, another than the one in force
  /// @param before  steps before the new target that are recorded; fewer than the unit records
  RecordedTrace step(std::uint32_t target, std::uint16_t before);

  /// The step of a running unit from one target to another, after a quarter of the trace at the first. Nothing
  /// is driven where the unit has not both targets, or no trace, or no drive.
  /// @param first, second  counts of millionths, two different ones
  RecordedStep step_between(std::uint32_t first, std::uint32_t second);

 private:
  template <class Answer, class Request>
  Answer require(const Request& request, std::size_t parameter = 0);

  void require_target(std::uint32_t target);
  std::uint16_t steps_recorded();
  void arm(link::Trigger trigger, std::uint16_t before);
  link::Telemetry telemetry();
  void wait(std::chrono::milliseconds time);
  RecordedTrace read();

  UnitLink& unit_;
  const UnitScales& scales_;
};

}  // namespace sonoglide::unit
