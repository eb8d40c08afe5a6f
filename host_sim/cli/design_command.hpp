/// `sonoglide design`: what a friction ratio takes of the drive.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "host_sim/cli/scene_input.hpp"

namespace sonoglide::cli {

struct DesignOptions {
  SceneOptions scene;
  std::vector<double> ratios;
  std::string velocity;  ///< FROM:TO in m/s; empty: the scene's
  std::string out;       ///< empty: out/<scene name>_design
  bool quiet = false;
};

/// Adds the command to the program; `options` outlives it and is filled in and checked by parsing.
CLI::App* add_design_command(CLI::App& program, DesignOptions& options);

/// Throws scene::SceneError, loop::ComputationError, report::OutputError, process::ProcessError; in
/// each case nothing was written.
void design(const DesignOptions& options);

}  // namespace sonoglide::cli
