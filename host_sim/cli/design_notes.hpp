/// What one should know of a closed loop before it runs.
#pragma once

#include <optional>

#include "host_sim/configure/control_design.hpp"

namespace sonoglide::cli {

/// Prints the notes of a controller's design on standard error; none in open loop.
void print_design_notes(const std::optional<configure::ControlDesign>& design);

}  // namespace sonoglide::cli
