#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "firmware/friction/dahl_friction_ratio.hpp"
#include "host_sim/cli/options.hpp"

namespace sonoglide::cli {
namespace {

struct RatioOptions {
  double velocity_ratio = 0.0;  ///< Vt / v̂ [-]
  double dahl_number = 0.0;     ///< Kt X / Fc [-]
};

/// Prints the number alone, with 17 significant digits.
void ratio(const RatioOptions& options) {
  fmt::print("{:.17g}\n",
             friction::dahl_friction_ratio(options.velocity_ratio, options.dahl_number));
}

}  // namespace

void add_ratio_command(CLI::App& program) {
  const auto options = std::make_shared<RatioOptions>();
  CLI::App* command = program.add_subcommand(
      "ratio", "Friction ratio of a Dahl contact under sinusoidal vibration, in closed form");
  command
      ->add_option("--velocity-ratio", options->velocity_ratio,
                   "Sliding velocity over peak vibration velocity, Vt / v [-]; its sign is ignored")
      ->required()
      ->type_name("R")
      ->check(in_range(-1e12, 1e12));
  command
      ->add_option("--dahl-number", options->dahl_number,
                   "Vibration amplitude over presliding distance, Kt X / Fc [-]")
      ->required()
      ->type_name("K")
      ->check(in_range(1e-12, 1e12));
  command->callback([options] { ratio(*options); });
}

}  // namespace sonoglide::cli
