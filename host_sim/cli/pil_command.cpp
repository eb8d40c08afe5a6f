#include "host_sim/cli/pil_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <vector>

#include "host_sim/cli/interruption.hpp"
#include "host_sim/cli/output_option.hpp"
#include "host_sim/cli/placed_error.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/emulator/board_list.hpp"
#include "host_sim/image/board_arithmetic.hpp"
#include "host_sim/image/controller_header.hpp"
#include "host_sim/image/image_builder.hpp"
#include "host_sim/image/measure_image.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/pil/image_control.hpp"
#include "host_sim/process/find_program.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/scene/reader.hpp"

namespace sonoglide::cli {
namespace {

std::string header_for(const scene::Scene& scene, const emulator::EmulatedBoard& board,
                       const std::string& path) {
  return with_places(path, [&] {
    image::require_arithmetic(scene, board);
    return image::controller_header(scene);
  });
}

/// What would stop the run later stops it before anything is built.
void require_emulator(const emulator::EmulatedBoard& board) {
  const std::string program(board.emulator);
  process::require_program(program,
                           program == "qemu-system-arm" ? "qemu-system-arm" : "qemu-system-misc");
}

loop::RunResult compute(const scene::Scene& scene, const emulator::EmulatedBoard& board,
                        const std::filesystem::path& image, report::RunReport& report, bool quiet,
                        const Interruption& interruption) {
  ProgressBar bar(stderr, !quiet);
  pil::ImageControl controller(board, image, [&] { interruption.check(); });
  loop::RunResult result = loop::run(scene, controller, run_watch(report, bar, interruption));
  result.image = controller.shut_down();
  return result;
}

void add_cost(const image::ImageCost& cost, loop::ImageRecord& record) {
  record.flash_bytes = cost.size.flash_bytes;
  record.ram_bytes = cost.size.ram_bytes;
  record.stack_unbounded_by = cost.stack.unbounded_by;
  if (cost.stack.unbounded_by.empty()) {
    record.stack_bytes_bound = cost.stack.bytes;
  }
}

std::string check_board(const std::string& name) {
  if (emulator::find_board(name) != nullptr) {
    return {};
  }
  std::string allowed;
  for (const emulator::EmulatedBoard& board : emulator::emulated_boards()) {
    allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", board.name);
  }
  return fmt::format("\"{}\" is no board; allowed: {}", name, allowed);
}

}  // namespace

CLI::App* add_pil_command(CLI::App& program, PilOptions& options) {
  CLI::App* command = program.add_subcommand(
      "pil",
      "Run a closed-loop scene with its controller as a firmware image on an emulated board");
  command->add_option("scene", options.scene, "The scene, a TOML file")
      ->required()
      ->type_name("SCENE.toml");
  command->add_option("--board", options.board, "The board")
      ->required()
      ->type_name("NAME")
      ->check(check_board);
  add_output_option(*command, options.out,
                    "report.html and summary.json and, where the scene records anything, "
                    "periods.csv and trace.csv [out/<scene name>_<board>]");
  command->add_flag("--quiet", options.quiet, "No progress bar and no printed summary");
  return command;
}

void pil(const PilOptions& options) {
  const emulator::EmulatedBoard& board = *emulator::find_board(options.board);
  const scene::Scene scene = scene::read_file(options.scene);
  const std::string header = header_for(scene, board, options.scene);
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path("out") / (scene.name + "_" + options.board)
                          : std::filesystem::path(options.out);
  require_emulator(board);
  const Interruption interruption;
  report::RunReport report(out, scene);
  const process::Attention attention = [&] { interruption.check(); };
  const std::filesystem::path image = image::build_image(board, header, attention);
  const image::ImageCost cost = image::measure_image(image, board, attention);
  loop::RunResult result = compute(scene, board, image, report, options.quiet, interruption);
  add_cost(cost, *result.image);
  report.finish(result);
  if (!options.quiet) {
    fmt::print("{}", report::run_text(scene, result, report.findings(), out));
  }
}

}  // namespace sonoglide::cli
