#include "host_sim/cli/commands.hpp"

#include <memory>
#include <string>
#include <vector>

#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/cli/board_options.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/arithmetic/comparison.hpp"

namespace sonoglide::cli {
namespace {

struct ArithmeticOptions {
  SceneOptions scene;
  std::vector<std::string> boards = {"microbit", "mps2-an385", "mps2-an386", "mps2-an500"};
  StudyOptions study;
};

using Boards = std::vector<const emulated::EmulatedBoard*>;

Boards chosen(const std::vector<std::string>& names) {
  Boards boards;
  for (const std::string& name : names) {
    boards.push_back(emulated::find_board(name));
    require_emulator(*boards.back());
  }
  return boards;
}

/// Throws what pil() throws, and process::ProcessError; in each case nothing was written and no
/// other program is left behind.
void arithmetic(const ArithmeticOptions& options) {
  const SceneInput input(options.scene);
  const experiment::Experiment experiment = input.read();
  const scene::Scene& scene = experiment.plant;
  input.with_places([&] {
    arithmetic::require_every_arithmetic(scene);
    return emulated::controller_header(experiment);
  });
  const Boards boards = chosen(options.boards);
  output::require_gnuplot();
  run_study(
      options.study, output_folder(options.study.out, scene.name, "_arithmetic"),
      {"arithmetic.csv", "targets.csv", "arithmetic.svg", "report.html"},
      [&](const auto& progress) { return arithmetic::compare(experiment, boards, progress); },
      [&](const auto& comparison) { return arithmetic::report(scene, comparison); });
}

}  // namespace

void add_arithmetic_command(CLI::App& program) {
  const auto options = std::make_shared<ArithmeticOptions>();
  CLI::App* command = program.add_subcommand(
      "arithmetic",
      "Error against run time of a closed-loop scene's controller on microcontrollers, "
      "in q15, q31, float32 and, where a board computes it, float64");
  add_scene_options(*command, options->scene, "its controller.arithmetic plays no part");
  command
      ->add_option("--board", options->boards,
                   "A board; may be repeated [microbit, mps2-an385, mps2-an386, mps2-an500]")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->check(check_board);
  add_study_options(*command, options->study,
                    "arithmetic.csv, targets.csv, arithmetic.svg and report.html "
                    "[out/<scene name>_arithmetic]",
                    "No progress bar and no printed table");
  command->callback([options] { arithmetic(*options); });
}

}  // namespace sonoglide::cli
