#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/program.hpp"

int main(int argument_count, char** arguments) {
  return sonoglide::cli::run_program(argument_count, arguments, {sonoglide::cli::add_run_command});
}
