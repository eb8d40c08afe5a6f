#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "host_sim/boards/emulated/board_limits.hpp"
#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/boards/emulated/run_image.hpp"
#include "host_sim/cli/board_options.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/step_forecast.hpp"
#include "host_sim/process/serial_port.hpp"
#include "host_sim/report/run_notes.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/report/self_excitation.hpp"

namespace sonoglide::cli {
namespace {

struct PilOptions {
  SceneOptions scene;
  std::string board;  ///< empty: at the port
  std::string port;
  std::string out;  ///< empty: out/<scene name>_<board>
  bool quiet = false;
};

/// Runs a scene with the image of its controller.
using RunImage = std::function<loop::RunResult(const experiment::Experiment& experiment,
                                               const loop::Watch& watch)>;

RunImage on_emulated_board(const SceneInput& input, const experiment::Experiment& experiment,
                           const std::string& name) {
  const emulated::EmulatedBoard& board = *emulated::find_board(name);
  const std::string header = input.with_places([&] {
    emulated::require_arithmetic(experiment.plant, board);
    emulated::require_carrier_board(experiment.plant, board);
    return emulated::controller_header(experiment);
  });
  require_emulator(board);
  return [&board, header](const experiment::Experiment& scene, const loop::Watch& watch) {
    return emulated::run_image(scene, board, header, watch);
  };
}

RunImage at_port(const SceneInput& input, const experiment::Experiment& experiment,
                 const std::string& device) {
  input.with_places([&] { return emulated::controller_header(experiment); });
  const auto port = std::make_shared<process::SerialPort>(device);
  return [port](const experiment::Experiment& scene, const loop::Watch& watch) {
    return emulated::run_board(scene, *port, watch);
  };
}

/// Throws what run() throws, and process::ProcessError or emulated::ImageError where the image
/// cannot be built or carried on; in each case nothing was written and no other program is left
/// behind.
void pil(const PilOptions& options) {
  const SceneInput input(options.scene);
  const experiment::Experiment experiment = input.read();
  const scene::Scene& scene = experiment.plant;
  const RunImage run_image = options.port.empty()
                                 ? on_emulated_board(input, experiment, options.board)
                                 : at_port(input, experiment, options.port);
  if (!options.quiet) {
    print_design_notes(experiment.design);
    print_notes(report::self_excitation_notes(scene));
    print_notes(report::target_notes(scene));
    announce_long_work(loop::expected_steps(scene));
  }
  const std::filesystem::path out = output_folder(
      options.out, scene.name, options.port.empty() ? "_" + options.board : "_on_board");
  report::RunReport report(out, experiment);
  const loop::RunResult result = [&] {
    ProgressBar bar(stderr, !options.quiet);
    return run_image(experiment, run_watch(report, bar));
  }();
  report.finish(result);
  if (!options.quiet) {
    fmt::print("{}{}", report::run_text(scene, result, report.findings()), report_line(out));
  }
  emulated::require_same(result);
}

}  // namespace

void add_pil_command(CLI::App& program) {
  const auto options = std::make_shared<PilOptions>();
  CLI::App* command = program.add_subcommand(
      "pil",
      "Run a closed-loop scene with its controller as a firmware image on an emulated board, or on a real one");
  add_scene_options(*command, options->scene);
  CLI::Option* board =
      command->add_option("--board", options->board, "An emulated board; the image is built for it")
          ->type_name("NAME")
          ->check(check_any_board);
  command
      ->add_option("--port", options->port,
                   "The serial device of a real board that holds what image --lockstep builds")
      ->type_name("DEVICE")
      ->check(not_empty("a serial device"))
      ->excludes(board);
  add_output_option(*command, options->out,
                    "report.html and summary.json and, where the scene records anything, "
                    "periods.csv and trace.csv [out/<scene name>_<board>, or _on_board]");
  command->add_flag("--quiet", options->quiet, "No progress bar, no notes, no printed summary");
  command->callback([options] {
    if (options->board.empty() && options->port.empty()) {
      throw CLI::RequiredError("--board or --port");
    }
    pil(*options);
  });
}

}  // namespace sonoglide::cli
