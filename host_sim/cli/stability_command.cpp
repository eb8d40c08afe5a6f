#include "host_sim/cli/stability_command.hpp"

#include <cstdint>
#include <memory>

#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/stability/study.hpp"

namespace sonoglide::cli {
namespace {

/// Throws output::OutputError, process::ProcessError; in each case nothing was written.
void stability(const StudyOptions& options, const StabilityWork& work) {
  output::require_gnuplot();
  run_study(
      options, options.out,
      {"report.html", "stability_map.csv", "stability_map.svg", "stability_map_float32.csv",
       "stability_map_float32.svg", "extremes.csv", "extremes_worst.csv"},
      [&](const auto& progress) {
        return stability::study(work.grid, work.random_scenes, progress);
      },
      stability::report);
}

}  // namespace

void add_stability_command_for(CLI::App& program, const StabilityWork& work) {
  const auto options = std::make_shared<StudyOptions>(StudyOptions{"out/stability"});
  CLI::App* command = program.add_subcommand(
      "stability", "Where each solver can be trusted: maps over step and stiffness, extreme cases");
  add_study_options(*command, *options,
                    "report.html, stability_map.csv and .svg, the same for float32, extremes.csv "
                    "and extremes_worst.csv [out/stability]");
  command->callback([options, work] { stability(*options, work); });
}

void add_stability_command(CLI::App& program) {
  constexpr std::uint64_t random_scenes = 100000;
  add_stability_command_for(program, {stability::full_grid(), random_scenes});
}

}  // namespace sonoglide::cli
