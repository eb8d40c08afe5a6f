/// The command line as a whole.
#pragma once

namespace sonoglide::cli {

/// Parses, runs the command, reports any failure on stderr; returns an ExitCode.
int run_program(int argument_count, const char* const* arguments);

}  // namespace sonoglide::cli
