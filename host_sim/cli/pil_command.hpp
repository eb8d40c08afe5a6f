/// `sonoglide pil`: a closed loop whose controller is an image on an emulated board.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "host_sim/cli/scene_input.hpp"

namespace sonoglide::cli {

struct PilOptions {
  SceneOptions scene;
  std::string board;
  std::string out;  ///< empty: out/<scene name>_<board>
  bool quiet = false;
};

/// Adds the command to the program; `options` outlives it and is filled in by parsing.
CLI::App* add_pil_command(CLI::App& program, PilOptions& options);

/// Throws what run() throws, and process::ProcessError or emulated::EmulatorError where the image
/// cannot be built or carried on; in each case nothing was written and no other program is left
/// behind.
void pil(const PilOptions& options);

}  // namespace sonoglide::cli
