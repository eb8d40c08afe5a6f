#include "host_sim/cli/board_options.hpp"

#include <fmt/format.h>

#include <string>

#include "host_sim/process/child_process.hpp"

namespace sonoglide::cli {

std::string check_board(const std::string& name) {
  if (emulated::find_board(name) != nullptr) {
    return {};
  }
  std::string allowed;
  for (const emulated::EmulatedBoard& board : emulated::emulated_boards()) {
    allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", board.name);
  }
  return fmt::format("\"{}\" is no board; allowed: {}", name, allowed);
}

void require_emulator(const emulated::EmulatedBoard& board) {
  const std::string program(board.emulator);
  process::require_program(program,
                           program == "qemu-system-arm" ? "qemu-system-arm" : "qemu-system-misc");
}

}  // namespace sonoglide::cli
