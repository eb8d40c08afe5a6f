/// `sonoglide stability`: where each solver can be trusted.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace sonoglide::cli {

struct StabilityOptions {
  std::string out = "out/stability";
  bool quiet = false;
};

/// Adds the command to the program; `options` outlives it and is filled in by parsing.
CLI::App* add_stability_command(CLI::App& program, StabilityOptions& options);

/// Throws report::OutputError, process::ProcessError; in each case nothing was written.
void stability(const StabilityOptions& options);

}  // namespace sonoglide::cli
