#include "host_sim/cli/board_options.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/boards/emulated/image.hpp"
#include "host_sim/boards/emulated/unit_image.hpp"
#include "host_sim/long_work/slurm.hpp"
#include "host_sim/process/child_process.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::cli {

namespace {

template <class Board>
std::string check_among(const std::vector<Board>& boards, const std::string& name) {
  std::string allowed;
  for (const Board& board : boards) {
    if (board.name == name) {
      return {};
    }
    allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", board.name);
  }
  const bool of_others =
      emulated::find_board(name) != nullptr || emulated::find_unit_board(name) != nullptr;
  return fmt::format("\"{}\" is no board{}; allowed: {}", name, of_others ? " of this command" : "",
                     allowed);
}

const std::map<std::string_view, const char*> packages = {
    {"qemu-system-arm", "qemu-system-arm"},
    {"qemu-system-riscv32", "qemu-system-misc"},
    {"node", "nodejs"}};

/// A text as one word of Tcl.
std::string script_word(const std::string& text) {
  std::string word;
  for (const char each : text) {
    if (std::string_view(" $\"[]{}\\;#").find(each) != std::string_view::npos) {
      word += '\\';
    }
    word += each;
  }
  return word;
}

}  // namespace

std::string check_board(const std::string& name) {
  return check_among(emulated::emulated_boards(), name);
}

std::string check_any_board(const std::string& name) {
  std::vector<emulated::EmulatedBoard> boards = emulated::emulated_boards();
  const auto& others = emulated::carrier_boards();
  boards.insert(boards.end(), others.begin(), others.end());
  return check_among(boards, name);
}

std::string check_unit_board(const std::string& name) {
  return check_among(emulated::unit_boards(), name);
}

std::string unit_header(const SceneInput& input, const experiment::Experiment& experiment,
                        const emulated::UnitBoard& board) {
  return input.with_places([&] {
    emulated::require_unit(experiment.plant, board);
    return emulated::controller_header(experiment);
  });
}

std::string shown_path(const std::filesystem::path& path) {
  const std::string text = process::printable(path.string());
  return text.empty() || text.front() != '-' ? text : "./" + text;
}

std::string load_command(const emulated::UnitFile& kind, const std::filesystem::path& path) {
  const std::string name = shown_path(path);
  const std::string words =
      kind.in_script
          ? long_work::shell_word("program " + script_word(name) + std::string(kind.after))
          : long_work::shell_word(name) + std::string(kind.after);
  return std::string(kind.before) + words;
}

void require_emulator(const emulated::EmulatedBoard& board) {
  process::require_program(std::string(board.emulator), packages.at(board.emulator));
  emulated::run_command(board, {});
}

}  // namespace sonoglide::cli
