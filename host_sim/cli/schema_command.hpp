/// `sonoglide schema`: the JSON Schema of scenes.
#pragma once

#include <CLI/CLI.hpp>

namespace sonoglide::cli {

/// Adds the command to the program; it has no options.
CLI::App* add_schema_command(CLI::App& program);

/// Prints the schema alone.
void schema();

}  // namespace sonoglide::cli
