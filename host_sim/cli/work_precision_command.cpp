#include "host_sim/cli/work_precision_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "host_sim/cli/output_option.hpp"
#include "host_sim/cli/placed_error.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/plot/gnuplot.hpp"
#include "host_sim/scene/reader.hpp"
#include "host_sim/work_precision/comparison.hpp"
#include "host_sim/work_precision/problem.hpp"
#include "host_sim/work_precision/report.hpp"

namespace sonoglide::cli {
namespace {

work_precision::Comparison compute(const peers::Problem& problem, bool quiet) {
  ProgressBar bar(stderr, !quiet);
  return work_precision::compare(problem, work_precision::solvers(), {},
                                 [&bar](double fraction) { bar.update(fraction); });
}

}  // namespace

CLI::App* add_work_precision_command(CLI::App& program, WorkPrecisionOptions& options) {
  CLI::App* command = program.add_subcommand(
      "work-precision", "Error against run time on an open-loop scene, every solver and peer");
  command->add_option("scene", options.scene, "The scene, a TOML file; its [solver] plays no part")
      ->required()
      ->type_name("SCENE.toml");
  add_output_option(*command, options.out,
                    "report.html, work_precision.csv and work_precision.svg [out/<scene "
                    "name>_work_precision]");
  command->add_flag("--quiet", options.quiet, "No progress bar and no printed summary");
  return command;
}

void work_precision(const WorkPrecisionOptions& options) {
  const scene::Scene scene = scene::read_file(options.scene);
  const peers::Problem problem =
      with_places(options.scene, [&] { return work_precision::problem_of(scene); });
  const std::filesystem::path out = output_folder(options.out, scene.name + "_work_precision");
  plot::require_gnuplot();
  require_writable(out);
  const work_precision::Comparison comparison = compute(problem, options.quiet);
  work_precision::write(out, scene, comparison);
  if (!options.quiet) {
    fmt::print("{}", work_precision::text(comparison, out));
  }
}

}  // namespace sonoglide::cli
