#include "host_sim/cli/run_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "host_sim/cli/interruption.hpp"
#include "host_sim/cli/output_option.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/scene/reader.hpp"

namespace sonoglide::cli {
namespace {

loop::RunResult compute(const scene::Scene& scene, report::RunReport& report, bool quiet,
                        const Interruption& interruption) {
  ProgressBar bar(stderr, !quiet);
  return loop::run(scene, run_watch(report, bar, interruption));
}

}  // namespace

CLI::App* add_run_command(CLI::App& program, RunOptions& options) {
  CLI::App* command =
      program.add_subcommand("run", "Run a scene: closed loop if it has a [controller] table");
  command->add_option("scene", options.scene, "The scene, a TOML file")
      ->required()
      ->type_name("SCENE.toml");
  add_output_option(*command, options.out,
                    "report.html and summary.json and, where the scene records anything, "
                    "periods.csv and trace.csv [out/<scene name>]");
  command
      ->add_option("--set", options.overrides,
                   "Replace or add one value of the scene, e.g. drive.force_amplitude_N=1920; "
                   "repeatable")
      ->type_name("TABLE.KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--quiet", options.quiet, "No progress bar and no printed summary");
  return command;
}

void run(const RunOptions& options) {
  const scene::Scene scene = scene::read_file(options.scene, options.overrides);
  const std::filesystem::path out = output_folder(options.out, scene.name);
  const Interruption interruption;
  report::RunReport report(out, scene);
  const loop::RunResult result = compute(scene, report, options.quiet, interruption);
  report.finish(result);
  if (!options.quiet) {
    fmt::print("{}", report::run_text(scene, result, report.findings(), out));
  }
}

}  // namespace sonoglide::cli
