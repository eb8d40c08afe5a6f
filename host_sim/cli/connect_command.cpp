#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/emulated_unit.hpp"
#include "host_sim/boards/emulated/image.hpp"
#include "host_sim/boards/emulated/unit_image.hpp"
#include "host_sim/boards/unit/console.hpp"
#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/cli/board_options.hpp"
#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/cli/program.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/process/serial_port.hpp"

namespace sonoglide::cli {
namespace {

using std::chrono_literals::operator""ms;

struct ConnectOptions {
  std::string device;
  SceneOptions scene;  ///< of the unit of an emulated board
  std::string board;   ///< emulated; empty: at the device
  bool quiet = false;
};

/// Lines as they are typed or come through a pipe.
class TypedLines {
 public:
  /// Waits for a line, and calls something meanwhile.
  /// @return false at the end of the input
  template <class Meanwhile>
  bool next(std::string& line, const Meanwhile& meanwhile) {
    // A unit takes its host for silent after a tenth of a second.
    constexpr auto interval = 25ms;
    for (std::size_t end = text_.find('\n'); end == std::string::npos; end = text_.find('\n')) {
      if (!process::wait_for_input(STDIN_FILENO, interval)) {
        meanwhile();
        continue;
      }
      char bytes[256];
      const ssize_t count = read(STDIN_FILENO, bytes, sizeof bytes);
      if (count <= 0) {
        line = std::exchange(text_, {});
        return !line.empty();
      }
      text_.append(bytes, static_cast<std::size_t>(count));
    }
    const std::size_t end = text_.find('\n');
    line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return true;
  }

 private:
  std::string text_;
};

/// @throws process::FileError  nobody can read it
void print(const std::string& line) {
  fmt::print("{}\n", process::printable(line));
  flush_output();
}

/// Where the sources and their examples are, or, of an installed program, where the examples are.
std::string usual_scene() {
  const std::filesystem::path tree = emulated::source_tree();
  const std::filesystem::path file = tree / "host_sim/scenes/target_step.toml";
  return std::filesystem::exists(file) ? file : tree.parent_path() / "scenes/target_step.toml";
}

/// Builds the unit of a scene and starts it.
std::unique_ptr<emulated::EmulatedUnit> started(const ConnectOptions& options) {
  const SceneInput input(options.scene);
  const emulated::UnitBoard& board = *emulated::find_unit_board(options.board);
  const emulated::EmulatedBoard& emulator = *emulated::find_board(options.board);
  const std::string header = unit_header(input, input.read(), board);
  require_emulator(emulator);
  return std::make_unique<emulated::EmulatedUnit>(
      emulator, input.with_places([&] { return emulated::build_unit(board, header); }));
}

/// @throws process::ProcessError  the device is absent, silent or no unit; or commands of a script
///         were refused
void connect(const ConnectOptions& options) {
  // The time of an emulator on a busy machine is not that of a board.
  constexpr auto patience_with_emulator = 5000ms;
  const auto own_unit =
      options.board.empty() ? std::unique_ptr<emulated::EmulatedUnit>() : started(options);
  process::SerialPort port(own_unit ? own_unit->device() : options.device);
  unit::UnitLink link(port, own_unit ? patience_with_emulator : unit::UnitLink::usual_patience);
  const std::string caveat =
      own_unit ? "the samples are those of a stand-in for the contact, not of a plant" : "";
  unit::Console console(link, caveat);
  const bool typed = isatty(STDIN_FILENO) == 1;
  if (typed && !options.quiet) {
    for (const std::string& line : console.identity()) {
      print(line);
    }
    print("connected; help lists the commands, Ctrl-D leaves");
  }
  TypedLines lines;
  const auto print_rows = [&] {
    for (const std::string& row : console.take_rows()) {
      print(row);
    }
  };
  const auto tell_news = [&] {
    print_rows();
    const std::string news = console.tell_news();
    if (!news.empty() && !options.quiet) {
      print(news);
    }
  };
  for (std::string line; lines.next(line, tell_news);) {
    for (const std::string& answer : console.carry_out(line)) {
      print(answer);
    }
    print_rows();
  }
  if (!typed && console.refused() > 0) {
    throw process::ProcessError(fmt::format("{}: commands that were not carried out: {}",
                                            process::printable(port.device()), console.refused()));
  }
}

}  // namespace

void add_connect_command(CLI::App& program) {
  const auto options = std::make_shared<ConnectOptions>();
  CLI::App* command = program.add_subcommand(
      "connect",
      "Talk to a running unit: each line of the standard input is a command, such as status, "
      "target 0.45, stop, params or tare; help lists all");
  command
      ->add_option("device", options->device,
                   "Serial device of the unit; with --emulated a closed-loop scene, its TOML file "
                   "[target_step.toml of the examples]")
      ->type_name("DEVICE")
      ->check(not_empty("a serial device"));
  CLI::Option* board = command
                           ->add_option("--emulated", options->board,
                                        "In place of a device an emulated board: its unit is built "
                                        "and runs until the end of the input")
                           ->type_name("BOARD")
                           ->check(check_board);
  add_set_option(*command, options->scene)->needs(board);
  command->add_flag("--quiet", options->quiet, "Prints the answers to commands alone");
  command->callback([options] {
    if (options->device.empty() && options->board.empty()) {
      throw CLI::RequiredError("DEVICE or --emulated");
    }
    if (!options->board.empty()) {
      options->scene.path =
          options->device.empty() ? usual_scene() : std::exchange(options->device, {});
      if (options->scene.path == "-") {
        throw CLI::ValidationError(
            "device", "- is the input that has the commands; allowed: the scene in a file");
      }
    }
    connect(*options);
  });
}

}  // namespace sonoglide::cli
