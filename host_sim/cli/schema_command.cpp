#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "host_sim/cli/commands.hpp"
#include "host_sim/scene_file/key_reference.hpp"

namespace sonoglide::cli {

void add_schema_command(CLI::App& program) {
  program
      .add_subcommand("schema", "JSON Schema of scenes, by which editors complete and check them")
      ->callback([] { fmt::print("{}", scene_file::json_schema()); });
}

}  // namespace sonoglide::cli
