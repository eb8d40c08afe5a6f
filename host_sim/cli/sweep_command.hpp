/// `sonoglide sweep`: many scenes at once.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "host_sim/cli/scene_input.hpp"

namespace sonoglide::cli {

struct SweepOptions {
  SceneOptions scene;
  std::string out;  ///< empty: out/<scene name>_sweep
  std::vector<std::string> vary;
  unsigned threads = 0;  ///< 0: one for each core
  bool quiet = false;
};

/// Adds the command to the program; `options` outlives it and is filled in by parsing.
CLI::App* add_sweep_command(CLI::App& program, SweepOptions& options);

/// Throws scene::SceneError and CLI::ValidationError, nothing was written then;
/// report::OutputError, process::ProcessError.
void sweep(const SweepOptions& options);

}  // namespace sonoglide::cli
