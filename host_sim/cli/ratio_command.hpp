/// `sonoglide ratio`: one value of the closed-form friction-ratio map.
#pragma once

#include <CLI/CLI.hpp>

namespace sonoglide::cli {

struct RatioOptions {
  double velocity_ratio = 0.0;  ///< Vt / v̂ [-]
  double dahl_number = 0.0;     ///< Kt X / Fc [-]
};

/// Adds the command to the program; `options` outlives it and is filled in and checked by parsing.
CLI::App* add_ratio_command(CLI::App& program, RatioOptions& options);

/// Prints the number alone, with 17 significant digits.
void ratio(const RatioOptions& options);

}  // namespace sonoglide::cli
