#include "host_sim/cli/commands.hpp"

#include <memory>

#include "host_sim/cli/options.hpp"
#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/work_precision/comparison.hpp"

namespace sonoglide::cli {
namespace {

struct WorkPrecisionOptions {
  SceneOptions scene;
  StudyOptions study;
};

/// Throws scene_file::SceneError, loop::ComputationError, process::FileError,
/// process::ProcessError; in each case nothing was written.
void work_precision(const WorkPrecisionOptions& options) {
  const SceneInput input(options.scene);
  const scene::Scene scene = input.read().plant;
  const peers::Problem problem =
      input.with_places([&] { return work_precision::problem_of(scene); });
  output::require_gnuplot();
  run_study(
      options.study, output_folder(options.study.out, scene.name, "_work_precision"),
      {"report.html", "work_precision.csv", "work_precision.svg"},
      [&](const auto& progress) {
        return work_precision::compare(problem, work_precision::solvers(), {}, progress);
      },
      [&](const auto& comparison) { return work_precision::report(scene, comparison); });
}

}  // namespace

void add_work_precision_command(CLI::App& program) {
  const auto options = std::make_shared<WorkPrecisionOptions>();
  CLI::App* command = program.add_subcommand(
      "work-precision", "Error against run time on an open-loop scene, every solver and peer");
  add_scene_options(*command, options->scene, "its [solver] plays no part");
  add_study_options(*command, options->study,
                    "report.html, work_precision.csv and work_precision.svg [out/<scene "
                    "name>_work_precision]");
  command->callback([options] { work_precision(*options); });
}

}  // namespace sonoglide::cli
