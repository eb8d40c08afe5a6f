#include <vector>

#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/program.hpp"
#include "tests/acceptance/cli/samples/sample_commands.hpp"

int main(int argument_count, char** arguments) {
  namespace cli = sonoglide::cli;
  std::vector<cli::AddCommand> commands(cli::commands.begin(), cli::commands.end());
  commands.push_back(cli::add_natural_mode_command);
  return cli::run_program(argument_count, arguments, commands);
}
