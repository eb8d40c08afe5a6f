/// The command line as a whole.
#pragma once

namespace sonoglide::cli {

enum ExitCode : int {
  done = 0,
  system_failed = 1,       ///< the file system or a tool
  bad_input = 2,           ///< usage or scene; nothing was written
  computation_failed = 3,  ///< time, state and reason are on stderr
};

/// Parses, runs the command, reports any failure on stderr; returns an ExitCode.
int run_program(int argument_count, const char* const* arguments);

}  // namespace sonoglide::cli
