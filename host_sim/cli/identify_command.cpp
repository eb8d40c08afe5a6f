#include "host_sim/cli/commands.hpp"

#include <CLI/CLI.hpp>

#include "host_sim/cli/identify_commands.hpp"

namespace sonoglide::cli {

void add_identify_command(CLI::App& program) {
  CLI::App* group = program.add_subcommand(
      "identify", "Parameters of a plant from measurements, each with its 95 % interval");
  group->require_subcommand(1);
  add_identify_impedance_command(*group);
  add_identify_friction_command(*group);
}

}  // namespace sonoglide::cli
