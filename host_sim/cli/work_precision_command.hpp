/// `sonoglide work-precision`: error against run time, every solver and every peer built in.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "host_sim/cli/scene_input.hpp"

namespace sonoglide::cli {

struct WorkPrecisionOptions {
  SceneOptions scene;
  std::string out;  ///< empty: out/<scene name>_work_precision
  bool quiet = false;
};

/// Adds the command to the program; `options` outlives it and is filled in by parsing.
CLI::App* add_work_precision_command(CLI::App& program, WorkPrecisionOptions& options);

/// Throws scene::SceneError, loop::ComputationError, report::OutputError, process::ProcessError; in
/// each case nothing was written.
void work_precision(const WorkPrecisionOptions& options);

}  // namespace sonoglide::cli
