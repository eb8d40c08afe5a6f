/// The command line as a whole.
#pragma once

#include <CLI/CLI.hpp>

#include <vector>

namespace sonoglide::cli {

/// Adds a command, with its options, to the program.
using AddCommand = void (*)(CLI::App& program);

/// Parses, runs the command, reports any failure on stderr; returns an ExitCode.
/// @param command_list  in the order of the help
int run_program(int argument_count, const char* const* arguments,
                const std::vector<AddCommand>& command_list);

}  // namespace sonoglide::cli
