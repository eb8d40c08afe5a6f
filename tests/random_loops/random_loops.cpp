// Runs random closed loops and prints what becomes of them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/random_loops/loops/outcome.hpp"
#include "tests/random_loops/loops/random_loop.hpp"
#include "tests/random_loops/loops/table.hpp"

namespace {

namespace random_loops = sonoglide::random_loops;
using random_loops::Verdict;

const std::map<std::string, random_loops::Vibration> vibrations = {
    {"unseen", random_loops::Vibration::unseen},
    {"felt", random_loops::Vibration::sensorless},
    {"damped", random_loops::Vibration::damped},
    {"alone", random_loops::Vibration::damped_alone},
    {"felt_biased", random_loops::Vibration::sensorless_biased},
    {"damped_biased", random_loops::Vibration::damped_biased},
    {"all_means", random_loops::Vibration::all_means}};

struct Options {
  std::uint32_t seed = 1;
  std::vector<std::uint32_t> counts = {1000};
  std::string listed;
  std::string table;
  std::optional<std::uint32_t> scene;
  std::string vibration = "unseen";
  std::vector<std::string> overrides;
};

std::string listing(const std::string& listed, const std::vector<random_loops::Outcome>& outcomes) {
  if (listed == "refused") {
    return random_loops::refusals_text(outcomes);
  }
  if (listed == "named-settled") {
    return random_loops::named_settled_csv(outcomes);
  }
  const std::map<std::string, std::optional<Verdict>> verdicts = {
      {"all", std::nullopt},
      {"unnamed", Verdict::never_unnamed},
      {"never", Verdict::never_named},
      {"late", Verdict::late},
      {"prompt", Verdict::prompt}};
  return random_loops::list_csv(outcomes, verdicts.at(listed));
}

std::string answer(const Options& options) {
  const random_loops::Vibration vibration = vibrations.at(options.vibration);
  if (options.scene) {
    return random_loops::scene_text(random_loops::random_loop(options.seed, *options.scene),
                                    vibration);
  }
  const auto most = *std::max_element(options.counts.begin(), options.counts.end());
  const auto outcomes = random_loops::outcomes(options.seed, most, vibration, options.overrides);
  return options.listed.empty() ? random_loops::table_csv(outcomes, options.counts)
                                : listing(options.listed, outcomes);
}

void give(const std::string& text, const std::string& path) {
  if (path.empty()) {
    fmt::print("{}", text);
    return;
  }
  std::ofstream file(path, std::ios::binary);
  file.exceptions(std::ios::failbit | std::ios::badbit);
  file << text;
}

}  // namespace

int main(int argument_count, char** arguments) {
  Options options;
  CLI::App program("Random closed loops, and what becomes of each step of their targets");
  program.add_option("--seed", options.seed, "Of the loops")->capture_default_str();
  program.add_option("--count", options.counts, "How many loops; repeatable: a table each")
      ->allow_extra_args(false)
      ->check(CLI::Range(1U, 1000000U))
      ->capture_default_str();
  program
      .add_option(
          "--list", options.listed,
          "In place of the table, a line for each step (all), or for each that never settles "
          "without a name for it (unnamed) or with one (never), settles after 1 ms (late) "
          "or before (prompt), or settles under a limit or fault (named-settled); or for "
          "each scene that is refused or fails (refused)")
      ->check(
          CLI::IsMember({"all", "unnamed", "never", "late", "prompt", "named-settled", "refused"}));
  program.add_option("--table", options.table, "Where to write the table [standard output]");
  program.add_option("--scene", options.scene, "In place of the table, this loop as TOML");
  program
      .add_option(
          "--vibration", options.vibration,
          "The same loops with their natural mode damped: felt in the friction (felt), seen by a "
          "vibration sensor (damped), and without a force sensor (alone); felt and seen with a bias "
          "against a slow mode (felt_biased, damped_biased); what suits the nominal mode, with a "
          "force sensor alone (all_means)")
      ->check(CLI::IsMember(
          {"unseen", "felt", "damped", "alone", "felt_biased", "damped_biased", "all_means"}))
      ->capture_default_str();
  program.add_option("--set", options.overrides, "KEY=VALUE in the scene of each loop; repeatable")
      ->allow_extra_args(false);
  CLI11_PARSE(program, argument_count, arguments);
  try {
    give(answer(options), options.table);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
