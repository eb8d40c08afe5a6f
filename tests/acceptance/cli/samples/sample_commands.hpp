/// The list of a program that has one command more, as commands.hpp would have it.
#pragma once

#include <CLI/CLI.hpp>

namespace sonoglide::cli {

void add_natural_mode_command(CLI::App& program);

}  // namespace sonoglide::cli
