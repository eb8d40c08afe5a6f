/// work_precision.svg.
#pragma once

#include <string>

#include "host_sim/studies/work_precision/comparison.hpp"

namespace sonoglide::work_precision {

/// Time for a carrier period against error, both axes logarithmic: one line for each solver through
/// the errors that its settings can be relied on for (see Standing), small points at the errors
/// that they happened to have.
/// @throws process::ProcessError
std::string draw(const Comparison& comparison, const std::string& title);

}  // namespace sonoglide::work_precision
