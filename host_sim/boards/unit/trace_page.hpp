/// A trace as a page.
#pragma once

#include <optional>
#include <string>

#include "host_sim/boards/unit/step_response.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"
#include "host_sim/boards/unit/unit_trace.hpp"
#include "host_sim/output/page.hpp"

namespace sonoglide::unit {

/// The course of what was read and answered, over the time since the step that triggered the trace, and what the
/// controller said of itself.
/// @param caveat  see Console
output::Page page_of(const RecordedTrace& trace, const UnitScales& scales,
                     const std::optional<StepResponse>& response, const std::string& caveat);

}  // namespace sonoglide::unit
