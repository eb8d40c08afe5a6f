/// A tool that is run to its end for what it does and says.
#pragma once

#include <string>
#include <vector>

#include "host_sim/process/wait_for_input.hpp"

namespace sonoglide::process {

/// Runs a tool with no input.
/// @return all that it wrote, errors included
/// @throws ProcessError  it cannot be started, or did not end with exit code 0; what() has all that
///         it wrote
/// @throws what `attention` throws; the tool and what it has started are ended then
std::string run_tool(const std::vector<std::string>& command, const Attention& attention);

}  // namespace sonoglide::process
