#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>

#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/boards/emulated/emulated_unit.hpp"
#include "host_sim/boards/emulated/image.hpp"
#include "host_sim/boards/emulated/unit_image.hpp"
#include "host_sim/cli/board_options.hpp"
#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/loop/step_forecast.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::cli {
namespace {

struct ImageOptions {
  SceneOptions scene;
  std::string board;
  std::string out;  ///< empty: out/<scene name>_<board>/unit or lockstep, and the usual ending
  double encoder_counts_per_m = 0.0;  ///< 0: none
  bool lockstep = false;
  bool quiet = false;
};

/// @throws CLI::ValidationError  the board is not loaded from such a file
const emulated::UnitFile& file_of(const ImageOptions& options, const emulated::UnitBoard& board) {
  if (options.out.empty()) {
    return board.files.front();
  }
  const std::string ending = std::filesystem::path(options.out).extension().string();
  if (const emulated::UnitFile* file = board.file(ending)) {
    return *file;
  }
  std::string allowed;
  for (const emulated::UnitFile& file : board.files) {
    allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", file.ending);
  }
  throw CLI::ValidationError(
      "--out",
      fmt::format("\"{}\" is no file that {} is loaded from; allowed: a name that ends in {}",
                  options.out, board.name, allowed));
}

std::filesystem::path path_of(const ImageOptions& options, const std::string& scene_name,
                              const emulated::UnitFile& file) {
  return options.out.empty()
             ? output_folder("", scene_name, "_" + options.board) /
                   fmt::format("{}{}", options.lockstep ? "lockstep" : "unit", file.ending)
             : std::filesystem::path(options.out);
}

std::string stack_text(const emulated::StackBound& stack) {
  return stack.unbounded_by.empty() ? fmt::format("{} B", stack.bytes)
                                    : fmt::format("not known: {}", stack.unbounded_by);
}

/// What the emulator of the board counts, where there is one.
std::string step_lines(const emulated::EmulatedBoard* emulator, const std::filesystem::path& unit,
                       const std::string& header, const experiment::Experiment& experiment) {
  if (emulator == nullptr) {
    return "not known: no emulator knows this board; its page in hal/ tells what example scenes take";
  }
  try {
    require_emulator(*emulator);
  } catch (const process::ProcessError& missing) {
    return fmt::format("not known: {}", missing.what());
  }
  announce_long_work(loop::expected_steps(experiment.plant));
  ProgressBar bar(stderr, true);
  loop::Watch watch;
  watch.progress = watching(bar);
  const emulated::UnitSteps steps =
      emulated::unit_steps(*emulator, unit, header, experiment, watch);
  if (steps.period_clocks > 0) {
    return fmt::format(
        "{} clocks in the median, {} at most, of {} in a carrier period ({} of them from a restart on)",
        steps.median, steps.most, steps.period_clocks, steps.steps);
  }
  const double period_s = experiment.design->scales.step_period_s();
  return fmt::format(
      "{} instructions in the median, {} at most (not cycles), over the {} steps of the scene; one "
      "each {:.4g} us is {:.3g} million instructions a second",
      steps.median, steps.most, steps.steps, 1e6 * period_s, 1e-6 * steps.most / period_s);
}

/// The image, and what it takes to load it; or to run it, where it is for an emulator alone.
void print_unit(const emulated::UnitBoard& board, const emulated::UnitFile& file,
                const std::filesystem::path& path, const emulated::ImageCost& cost,
                const std::string& steps) {
  fmt::print("{}: {}, for {} ({})\n", steps.empty() ? "image in lockstep" : "unit",
             shown_path(path), board.name, board.core);
  fmt::print("size: {} B flash, {} B static RAM, deepest stack {}\n", cost.size.flash_bytes,
             cost.size.ram_bytes, stack_text(cost.stack));
  if (!steps.empty()) {
    fmt::print("step: {}\n", steps);
  }
  fmt::print("{} {}\n", board.is_emulated ? "run: " : "load:", load_command(file, path));
}

emulated::UnitBoard board_of(const ImageOptions& options) {
  emulated::UnitBoard board = *emulated::find_unit_board(options.board);
  if (options.lockstep) {
    board.image_suffix = "_serial";
  }
  return board;
}

/// @throws CLI::ValidationError  nothing would read it
void require_encoder(const emulated::UnitBoard& board, const experiment::Experiment& experiment) {
  if (!board.reads_encoder) {
    std::string allowed;
    for (const emulated::UnitBoard& each : emulated::unit_boards()) {
      allowed += each.reads_encoder ? fmt::format(" {}", each.name) : "";
    }
    throw CLI::ValidationError(
        "--encoder", fmt::format("{} reads no encoder; allowed: --board{}", board.name, allowed));
  }
  if (!experiment.nominal.controller->texture) {
    throw CLI::ValidationError(
        "--encoder",
        "the scene has no texture, which alone lies along an encoder; allowed: "
        "controller.target_texture in the scene");
  }
}

/// Nothing is written unless all of it can be.
void image(const ImageOptions& options) {
  const emulated::UnitBoard board = board_of(options);
  const emulated::UnitFile& file = file_of(options, board);
  const SceneInput input(options.scene);
  const experiment::Experiment experiment = input.read();
  const std::string header =
      options.lockstep ? input.with_places([&] { return emulated::controller_header(experiment); })
                       : unit_header(input, experiment, board);
  if (options.encoder_counts_per_m > 0.0) {
    require_encoder(board, experiment);
  }
  const std::filesystem::path path = path_of(options, experiment.plant.name, file);
  const std::filesystem::path absolute = std::filesystem::absolute(path);
  const std::string name = absolute.filename().string();
  process::OutputFolder folder(absolute.parent_path(), {name});
  const std::filesystem::path built = input.with_places(
      [&] { return emulated::build_unit(board, header, options.encoder_counts_per_m); });
  const emulated::ImageCost cost = emulated::measure_image(built, board);
  const std::string steps =
      options.quiet || options.lockstep
          ? ""
          : step_lines(emulated::find_board(board.name), built, header, experiment);
  folder.write(name, emulated::unit_file(board, built, file.ending));
  folder.commit();
  if (!options.quiet) {
    print_design_notes(experiment.design);
    print_unit(board, file, path, cost, steps);
  }
}

}  // namespace

void add_image_command(CLI::App& program) {
  const auto options = std::make_shared<ImageOptions>();
  CLI::App* command = program.add_subcommand(
      "image", "Build the unit of a closed-loop scene for a board, which it drives by itself");
  add_scene_options(*command, options->scene);
  command->add_option("--board", options->board, "The board")
      ->required()
      ->type_name("NAME")
      ->check(check_unit_board);
  command
      ->add_option(
          "--out", options->out,
          "The image [out/<scene name>_<board>/unit.uf2, lockstep.uf2, or .elf where a board takes none]")
      ->type_name("FILE.elf|.uf2|.bin")
      ->check(not_empty("a file"));
  CLI::Option* lockstep = command->add_flag("--lockstep", options->lockstep,
                                            "In place of the unit the image that pil --port runs");
  command
      ->add_option("--encoder", options->encoder_counts_per_m,
                   "Counts in a metre of the encoder that the texture lies along "
                   "[none: it lies along the sensed velocity]")
      ->type_name("COUNTS_PER_M")
      ->check(in_range(1.0, 1e12))
      ->excludes(lockstep);
  command->add_flag("--quiet", options->quiet, "No notes, and no word on the image");
  command->callback([options] { image(*options); });
}

}  // namespace sonoglide::cli
