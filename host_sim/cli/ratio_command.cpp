#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdlib>
#include <memory>
#include <string>

#include "firmware/friction/dahl_friction_ratio.hpp"

namespace sonoglide::cli {
namespace {

struct RatioOptions {
  double velocity_ratio = 0.0;  ///< Vt / v̂ [-]
  double dahl_number = 0.0;     ///< Kt X / Fc [-]
};

/// What is wrong with a number, or nothing.
std::string check_number(const std::string& text, double low, double high) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') {
    return fmt::format("\"{}\" is not a number; allowed: a number, {:g} to {:g}", text, low, high);
  }
  if (!(value >= low && value <= high)) {
    return fmt::format("{} is out of range; allowed: {:g} to {:g}", text, low, high);
  }
  return {};
}

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
      ->check([](const std::string& text) { return check_number(text, -1e12, 1e12); });
  command
      ->add_option("--dahl-number", options->dahl_number,
                   "Vibration amplitude over presliding distance, Kt X / Fc [-]")
      ->required()
      ->type_name("K")
      ->check([](const std::string& text) { return check_number(text, 1e-12, 1e12); });
  command->callback([options] { ratio(*options); });
}

}  // namespace sonoglide::cli
