/// Tools: where they are, and running them to their end for what they do and say.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::process {

/// @param package  of Debian, that has the program
/// @return the program's place in PATH
/// @throws ProcessError  it has none
std::filesystem::path require_program(const std::string& program, const std::string& package);

/// Runs a tool to its end.
/// @param input  on its standard input
/// @return what it wrote on its standard output
/// @throws ProcessError  it cannot be started, or did not end with exit code 0; what() has all that
///         it wrote, errors last
std::string run_tool(const std::vector<std::string>& command, std::string_view input = {});

}  // namespace sonoglide::process
