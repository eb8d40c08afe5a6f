#include "host_sim/cli/program.hpp"
#include "host_sim/cli/stability_command.hpp"

namespace {

namespace cli = sonoglide::cli;

/// The full command takes minutes.
void add_small_stability_command(CLI::App& program) {
  cli::StabilityWork work;
  work.grid.contact_stiffness_N_per_m = {1e4, 1e8};
  work.grid.tolerance = {1e-4, 1e-8};
  work.grid.steps_per_period = {16.0, 256.0};
  work.grid.periods = 2;
  work.random_scenes = 50;
  cli::add_stability_command_for(program, work);
}

}  // namespace

int main(int argument_count, char** arguments) {
  return cli::run_program(argument_count, arguments, {add_small_stability_command});
}
