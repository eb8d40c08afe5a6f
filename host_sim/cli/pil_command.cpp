#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "host_sim/cli/board_options.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/emulated/board_list.hpp"
#include "host_sim/emulated/controller_header.hpp"
#include "host_sim/emulated/run_image.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/step_forecast.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/report/self_excitation.hpp"

namespace sonoglide::cli {
namespace {

struct PilOptions {
  SceneOptions scene;
  std::string board;
  std::string out;  ///< empty: out/<scene name>_<board>
  bool quiet = false;
};

loop::RunResult compute(const experiment::Experiment& experiment,
                        const emulated::EmulatedBoard& board, const std::string& header,
                        report::RunReport& report, bool quiet) {
  ProgressBar bar(stderr, !quiet);
  return emulated::run_image(experiment, board, header, run_watch(report, bar));
}

/// Of a board that makes the carrier itself.
constexpr const char* counts_are_clocks =
    "on this board they are clocks, from the carrier's interrupt to its end\n";

std::string header_for(const SceneInput& input, const experiment::Experiment& experiment,
                       const emulated::EmulatedBoard& board) {
  return input.with_places([&] {
    emulated::require_arithmetic(experiment.plant, board);
    emulated::require_carrier_board(experiment.plant, board);
    return emulated::controller_header(experiment);
  });
}

/// Throws what run() throws, and process::ProcessError or emulated::EmulatorError where the image
/// cannot be built or carried on; in each case nothing was written and no other program is left
/// behind.
void pil(const PilOptions& options) {
  const emulated::EmulatedBoard& board = *emulated::find_board(options.board);
  const SceneInput input(options.scene);
  const experiment::Experiment experiment = input.read();
  const scene::Scene& scene = experiment.plant;
  const std::string header = header_for(input, experiment, board);
  if (!options.quiet) {
    print_design_notes(experiment.design);
    print_notes(report::self_excitation_notes(scene));
    announce_long_work(loop::expected_steps(scene));
  }
  const std::filesystem::path out = output_folder(options.out, scene.name, "_" + options.board);
  require_emulator(board);
  report::RunReport report(out, experiment);
  const loop::RunResult result = compute(experiment, board, header, report, options.quiet);
  report.finish(result);
  if (!options.quiet) {
    fmt::print("{}{}{}", report::run_text(scene, result, report.findings()),
               board.image_suffix.empty() ? "" : counts_are_clocks, report_line(out));
  }
  emulated::require_same(result);
}

}  // namespace

void add_pil_command(CLI::App& program) {
  const auto options = std::make_shared<PilOptions>();
  CLI::App* command = program.add_subcommand(
      "pil",
      "Run a closed-loop scene with its controller as a firmware image on an emulated board");
  add_scene_options(*command, options->scene);
  command->add_option("--board", options->board, "The board")
      ->required()
      ->type_name("NAME")
      ->check(check_any_board);
  add_output_option(*command, options->out,
                    "report.html and summary.json and, where the scene records anything, "
                    "periods.csv and trace.csv [out/<scene name>_<board>]");
  command->add_flag("--quiet", options->quiet, "No progress bar, no notes, no printed summary");
  command->callback([options] { pil(*options); });
}

}  // namespace sonoglide::cli
