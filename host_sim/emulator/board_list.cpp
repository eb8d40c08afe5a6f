#include "host_sim/emulator/board_list.hpp"

#include <algorithm>

namespace sonoglide::emulator {

const std::vector<EmulatedBoard>& emulated_boards() {
  static const std::vector<EmulatedBoard> boards = {
      {"microbit", "Cortex-M0", "arm-cortex-m0", "qemu-system-arm", {"-machine", "microbit"}},
      {"mps2-an385", "Cortex-M3", "arm-cortex-m3", "qemu-system-arm", {"-machine", "mps2-an385"}},
      {"mps2-an386", "Cortex-M4F", "arm-cortex-m4f", "qemu-system-arm", {"-machine", "mps2-an386"}},
      {"netduinoplus2",
       "Cortex-M4F",
       "arm-cortex-m4f",
       "qemu-system-arm",
       {"-machine", "netduinoplus2"}},
      {"mps2-an500",
       "Cortex-M7",
       "arm-cortex-m7",
       "qemu-system-arm",
       {"-machine", "mps2-an500"},
       true},
      {"mps2-an505", "Cortex-M33", "arm-cortex-m33", "qemu-system-arm", {"-machine", "mps2-an505"}},
      {"riscv32-virt",
       "RV32IMAC",
       "riscv-rv32imac",
       "qemu-system-riscv32",
       {"-machine", "virt", "-bios", "none"}},
  };
  return boards;
}

const EmulatedBoard* find_board(std::string_view name) {
  const auto& boards = emulated_boards();
  const auto found = std::find_if(boards.begin(), boards.end(),
                                  [&](const EmulatedBoard& board) { return board.name == name; });
  return found == boards.end() ? nullptr : &*found;
}

std::vector<std::string> emulator_command(const EmulatedBoard& board, const std::string& image) {
  std::vector<std::string> command{std::string(board.emulator)};
  command.insert(command.end(), board.machine_arguments.begin(), board.machine_arguments.end());
  for (const char* argument : {"-nodefaults", "-display", "none", "-semihosting-config",
                               "enable=on,target=native", "-kernel"}) {
    command.emplace_back(argument);
  }
  command.push_back(image);
  return command;
}

}  // namespace sonoglide::emulator
