#include "host_sim/cli/commands.hpp"

#include <filesystem>
#include <memory>
#include <string>

#include "host_sim/cli/options.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/work_precision/comparison.hpp"
#include "host_sim/studies/work_precision/report.hpp"

namespace sonoglide::cli {
namespace {

struct WorkPrecisionOptions {
  SceneOptions scene;
  std::string out;  ///< empty: out/<scene name>_work_precision
  bool quiet = false;
};

/// Throws scene_file::SceneError, loop::ComputationError, output::OutputError,
/// process::ProcessError; in each case nothing was written.
void work_precision(const WorkPrecisionOptions& options) {
  const SceneInput input(options.scene);
  const scene::Scene scene = input.read().plant;
  const peers::Problem problem =
      input.with_places([&] { return work_precision::problem_of(scene); });
  const std::filesystem::path out = output_folder(options.out, scene.name, "_work_precision");
  output::require_gnuplot();
  require_writable(out, {"report.html", "work_precision.csv", "work_precision.svg"});
  const work_precision::SolverComparison comparison =
      with_bar(options.quiet, [&](const auto& progress) {
        return work_precision::compare(problem, work_precision::solvers(), {}, progress);
      });
  publish(out, work_precision::report(scene, comparison), options.quiet);
}

}  // namespace

void add_work_precision_command(CLI::App& program) {
  const auto options = std::make_shared<WorkPrecisionOptions>();
  CLI::App* command = program.add_subcommand(
      "work-precision", "Error against run time on an open-loop scene, every solver and peer");
  add_scene_options(*command, options->scene, "its [solver] plays no part");
  add_output_option(*command, options->out,
                    "report.html, work_precision.csv and work_precision.svg [out/<scene "
                    "name>_work_precision]");
  command->add_flag("--quiet", options->quiet, "No progress bar and no printed summary");
  command->callback([options] { work_precision(*options); });
}

}  // namespace sonoglide::cli
