#include "host_sim/cli/schema_command.hpp"

#include <fmt/format.h>

#include "host_sim/scene_file/json_schema.hpp"

namespace sonoglide::cli {

CLI::App* add_schema_command(CLI::App& program) {
  return program.add_subcommand("schema",
                                "JSON Schema of scenes, by which editors complete and check them");
}

void schema() {
  fmt::print("{}", scene_file::json_schema());
}

}  // namespace sonoglide::cli
