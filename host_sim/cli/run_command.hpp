/// `sonoglide run`: one scene, computed and reported.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "host_sim/cli/scene_input.hpp"

namespace sonoglide::cli {

struct RunOptions {
  SceneOptions scene;
  std::string out;  ///< empty: out/<scene name>
  bool json = false;
  bool quiet = false;
};

/// Adds the command to the program; `options` outlives it and is filled in by parsing.
CLI::App* add_run_command(CLI::App& program, RunOptions& options);

/// Throws scene::SceneError, loop::ComputationError, report::OutputError, or ends by the signal
/// that interrupts it; in each case nothing was written.
void run(const RunOptions& options);

}  // namespace sonoglide::cli
