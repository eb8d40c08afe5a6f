/// The command line as a whole.
#pragma once

#include <vector>

namespace CLI {
class App;
}

namespace sonoglide::cli {

enum ExitCode : int {
  done = 0,
  system_failed = 1,       ///< the file system or a tool
  bad_input = 2,           ///< usage or scene; nothing was written
  computation_failed = 3,  ///< time, state and reason are on stderr
};

/// Adds a command, with its options, to the program.
using AddCommand = void (*)(CLI::App& program);

/// Parses, runs the command, reports any failure on stderr; returns an ExitCode.
/// @param command_list  in the order of the help
int run_program(int argument_count, const char* const* arguments,
                const std::vector<AddCommand>& command_list);

/// A full disk or a closed pipe shows only when the buffer goes out.
/// @throws process::FileError  standard output cannot be written
void flush_output();

}  // namespace sonoglide::cli
