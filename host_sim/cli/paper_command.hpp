/// `sonoglide paper`: the paper's figures and balance.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace sonoglide::cli {

struct PaperOptions {
  std::string out = "paper";
  std::optional<int> figure;
  bool quiet = false;
};

/// Adds the command to the program; `options` outlives it and is filled in by parsing.
CLI::App* add_paper_command(CLI::App& program, PaperOptions& options);

/// Throws report::OutputError, process::ProcessError, loop::ComputationError; in each case nothing
/// was written.
void paper(const PaperOptions& options);

}  // namespace sonoglide::cli
