/// Tools: where they are, and running them to their end for what they do and say.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::process {

/// @param package  of Debian, that has the program
/// @return the program's place in PATH
/// @throws ProcessError  it has none
std::filesystem::path require_program(const std::string& program, const std::string& package);

/// Runs a tool with no input.
/// @return all that it wrote, errors included
/// @throws ProcessError  it cannot be started, or did not end with exit code 0; what() has all that
///         it wrote
/// @throws what `attention` throws; the tool and what it has started are ended then
std::string run_tool(const std::vector<std::string>& command, const Attention& attention);

}  // namespace sonoglide::process
