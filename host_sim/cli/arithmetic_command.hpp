/// `sonoglide arithmetic`: error against run time of a controller, by arithmetic and board.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "host_sim/cli/scene_input.hpp"

namespace sonoglide::cli {

struct ArithmeticOptions {
  SceneOptions scene;
  std::vector<std::string> boards = {"microbit", "mps2-an385", "mps2-an386", "mps2-an500"};
  std::string out;  ///< empty: out/<scene name>_arithmetic
  bool quiet = false;
};

/// Adds the command to the program; `options` outlives it and is filled in by parsing.
CLI::App* add_arithmetic_command(CLI::App& program, ArithmeticOptions& options);

/// Throws what pil() throws, and process::ProcessError; in each case nothing was written and no
/// other program is left behind.
void arithmetic(const ArithmeticOptions& options);

}  // namespace sonoglide::cli
