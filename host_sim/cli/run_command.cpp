#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "host_sim/cli/options.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/step_forecast.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/report/run_csv.hpp"
#include "host_sim/report/run_findings.hpp"
#include "host_sim/report/run_notes.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/report/self_excitation.hpp"

namespace sonoglide::cli {
namespace {

struct RunOptions {
  SceneOptions scene;
  std::string out;  ///< empty: out/<scene name>
  bool json = false;
  bool quiet = false;
};

/// The summary alone, nothing written.
std::string compute_summary(const experiment::Experiment& experiment, bool quiet) {
  report::RunFindings findings(experiment);
  ProgressBar bar(stderr, !quiet);
  loop::Watch watch;
  findings.join(watch);
  watch.progress = watching(bar);
  const loop::RunResult result = loop::run(experiment, watch);
  return report::summary_text(experiment, result, findings);
}

/// On a terminal somebody waits, and may think again.
void announce_recording(const scene::Scene& scene) {
  const auto size = report::recording_size(scene);
  if (size && isatty(fileno(stderr)) == 1) {
    process::show_on_stderr(
        fmt::format("trace.csv and periods.csv: {:.0f} and {:.0f} rows, about {:.2g} MB together",
                    size->trace_rows, size->period_rows, size->bytes * 1e-6));
  }
}

/// @return what is printed
std::string compute_report(const experiment::Experiment& experiment,
                           const std::filesystem::path& out, const RunOptions& options) {
  report::RunReport report(out, experiment);
  ProgressBar bar(stderr, !options.quiet);
  const loop::RunResult result = loop::run(experiment, run_watch(report, bar));
  report.finish(result);
  if (options.json) {
    return report::summary_text(experiment, result, report.findings());
  }
  return options.quiet
             ? std::string()
             : report::run_text(experiment.plant, result, report.findings()) + report_line(out);
}

/// Throws scene_file::SceneError, loop::ComputationError, process::FileError, or ends by the
/// signal that interrupts it; in each case nothing was written.
void run(const RunOptions& options) {
  const experiment::Experiment experiment = SceneInput(options.scene).read();
  const scene::Scene& scene = experiment.plant;
  if (!options.quiet) {
    print_design_notes(experiment.design);
    print_notes(report::self_excitation_notes(scene));
    print_notes(report::target_notes(scene));
    announce_long_work(loop::expected_steps(scene));
  }
  const bool written = !options.json || !options.out.empty();
  if (written && !options.quiet) {
    announce_recording(scene);
  }
  fmt::print("{}", written
                       ? compute_report(experiment, output_folder(options.out, scene.name), options)
                       : compute_summary(experiment, options.quiet));
}

}  // namespace

void add_run_command(CLI::App& program) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      program.add_subcommand("run", "Run a scene: closed loop if it has a [controller] table");
  add_scene_options(*command, options->scene);
  add_output_option(*command, options->out,
                    "report.html and summary.json and, where the scene records anything, "
                    "periods.csv and trace.csv [out/<scene name>]");
  command->add_flag("--json", options->json,
                    "Print summary.json and nothing else; files are then written only where --out "
                    "names a folder");
  command->add_flag("--quiet", options->quiet, "No progress bar, no notes, no printed summary");
  command->callback([options] { run(*options); });
}

}  // namespace sonoglide::cli
