#include "host_sim/cli/stability_command.hpp"

#include <cstdint>
#include <memory>

#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/self_excited/study.hpp"
#include "host_sim/studies/stability/study.hpp"

namespace sonoglide::cli {
namespace {

struct StabilityOptions {
  SceneOptions scene;  ///< without a path: the solvers' stability
  StudyOptions study;
};

/// Throws process::FileError, process::ProcessError; in each case nothing was written.
void solvers(const StudyOptions& options, const StabilityWork& work) {
  run_study(
      options, options.out.empty() ? "out/stability" : options.out,
      {"report.html", "stability_map.csv", "stability_map.svg", "stability_map_float32.csv",
       "stability_map_float32.svg", "extremes.csv", "extremes_worst.csv"},
      [&](const auto& progress) {
        return stability::study(work.grid, work.random_scenes, progress);
      },
      stability::report);
}

/// Throws scene_file::SceneError, process::FileError, process::ProcessError; in each case nothing was
/// written.
void self_excited(const StabilityOptions& options) {
  const SceneInput input(options.scene);
  const experiment::Experiment experiment = input.read();
  const self_excited::Task task =
      input.with_places([&] { return self_excited::make_task(experiment.plant); });
  run_study(
      options.study, output_folder(options.study.out, task.scene.name, "_self_excited"),
      {"report.html", "self_excited.csv", "self_excited.json", "self_excited.svg"},
      [&](const auto& progress) { return self_excited::study(task, progress); },
      self_excited::report);
}

void stability(const StabilityOptions& options, const StabilityWork& work) {
  output::require_gnuplot();
  if (options.scene.path.empty()) {
    solvers(options.study, work);
  } else {
    self_excited(options);
  }
}

}  // namespace

void add_stability_command_for(CLI::App& program, const StabilityWork& work) {
  const auto options = std::make_shared<StabilityOptions>();
  CLI::App* command = program.add_subcommand(
      "stability",
      "Where each solver can be trusted: maps over step and stiffness, extreme cases. With a scene "
      "and --self-excited: where its steady sliding excites itself, over belt speed and drive");
  add_scene_options(*command, options->scene, "its initial state and [solver] play no part");
  CLI::Option* scene = command->get_option("scene")->required(false);
  CLI::Option* self_excited =
      command->add_flag("--self-excited",
                        "Whether steady sliding of the scene excites itself, and "
                        "the drives that quench it");
  scene->needs(self_excited);
  command->get_option("--set")->needs(scene);
  add_study_options(*command, options->study,
                    "report.html, stability_map.csv and .svg, the same for float32, extremes.csv "
                    "and extremes_worst.csv [out/stability]; of a scene report.html, "
                    "self_excited.csv, .json and .svg [out/<scene name>_self_excited]");
  command->callback([options, work, self_excited] {
    if (self_excited->count() > 0 && options->scene.path.empty()) {
      throw CLI::RequiredError("scene");
    }
    stability(*options, work);
  });
}

void add_stability_command(CLI::App& program) {
  constexpr std::uint64_t random_scenes = 100000;
  add_stability_command_for(program, {stability::full_grid(), random_scenes});
}

}  // namespace sonoglide::cli
