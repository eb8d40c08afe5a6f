/// What a trace says of the answer to a new target.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host_sim/boards/unit/step_recorder.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"

namespace sonoglide::unit {

/// The course of the friction force from one level to another. Times count from the step of the controller that
/// is the first to have the new target.
struct StepCourse {
  double rise_s = 0.0;  ///< from 10 % of the step to 90 %
  std::optional<double>
      settling_s;          ///< until it stays within 5 % of the step; absent: not in the trace
  double overshoot = 0.0;  ///< farthest beyond the last level, part of the step; 0 or more
};

struct StepResponse {
  double before_N = 0.0;  ///< mean of the friction force before the new target
  double after_N = 0.0;   ///< of the last quarter of the steps since
  double ripple_N = 0.0;  ///< half peak to peak about these two, the larger of both
  /// Absent where the ripple is 5 % of the step or more: it would be taken for the course.
  std::optional<StepCourse> course;
  bool settled_before = false;  ///< the loop, at the target before
  std::uint32_t end_codes = 0;  ///< of the last step, see names_of_codes()
};

/// @param step  with a step of the controller or more before the new target and four or more after it
StepResponse step_response(const RecordedStep& step, const UnitScales& scales);

/// In a line.
std::string text_of(const StepResponse& response);

}  // namespace sonoglide::unit
