#include "host_sim/boards/emulated/board_list.hpp"

#include <algorithm>

namespace sonoglide::emulated {
namespace {

/// An MPS2 board has a network chip, which the emulator wants connected; this one leads nowhere.
std::vector<std::string_view> mps2(std::string_view machine) {
  return {"-machine", machine, "-nic", "user,restrict=on"};
}

/// Of the emulator's time; the largest that it offers.
constexpr double ns_per_instruction = 1024.0;
constexpr const char* instruction_time = "shift=10";  // 2^10 ns

/// A Cortex-M counts 256 to a tick of its system timer.
constexpr double system_timer(double clock_Hz) {
  return 256.0 * clock_Hz * 1e-9 * ns_per_instruction;
}

/// A RISC-V hart counts its instructions, for which this emulator takes their nanoseconds.
constexpr double retired_instructions = ns_per_instruction;

}  // namespace

const std::vector<EmulatedBoard>& emulated_boards() {
  constexpr std::string_view arm = "qemu-system-arm";
  constexpr std::string_view riscv = "qemu-system-riscv32";
  static const std::vector<EmulatedBoard> boards = {
      {{"microbit", "Cortex-M0", "arm-cortex-m0"},
       arm,
       {"-machine", "microbit"},
       system_timer(16e6)},
      {{"mps2-an385", "Cortex-M3", "arm-cortex-m3"}, arm, mps2("mps2-an385"), system_timer(25e6)},
      {{"mps2-an386", "Cortex-M4F", "arm-cortex-m4f"}, arm, mps2("mps2-an386"), system_timer(25e6)},
      {{"netduinoplus2", "Cortex-M4F", "arm-cortex-m4f"},
       arm,
       {"-machine", "netduinoplus2"},
       system_timer(168e6)},
      {{"mps2-an500", "Cortex-M7", "arm-cortex-m7", true},
       arm,
       mps2("mps2-an500"),
       system_timer(25e6)},
      {{"mps2-an505", "Cortex-M33", "arm-cortex-m33"}, arm, mps2("mps2-an505"), system_timer(20e6)},
      {{"riscv32-virt", "RV32IMAC", "riscv-rv32imac"},
       riscv,
       {"-machine", "virt", "-bios", "none"},
       retired_instructions},
  };
  return boards;
}

const std::vector<EmulatedBoard>& carrier_boards() {
  static const std::vector<EmulatedBoard> carriers = {
      {{"pico", "Cortex-M0+", "arm-cortex-m0plus", false, false}, "node", {}, 1.0, "_scene"}};
  return carriers;
}

const EmulatedBoard* find_board(std::string_view name) {
  for (const auto* boards : {&emulated_boards(), &carrier_boards()}) {
    const auto found = std::find_if(boards->begin(), boards->end(),
                                    [&](const EmulatedBoard& board) { return board.name == name; });
    if (found != boards->end()) {
      return &*found;
    }
  }
  return nullptr;
}

std::vector<std::string> emulator_command(const EmulatedBoard& board, const std::string& image) {
  std::vector<std::string> command{std::string(board.emulator)};
  command.insert(command.end(), board.machine_arguments.begin(), board.machine_arguments.end());
  for (const char* argument : {"-nodefaults", "-display", "none", "-semihosting-config",
                               "enable=on,target=native", "-icount", instruction_time, "-kernel"}) {
    command.emplace_back(argument);
  }
  command.push_back(image);
  return command;
}

std::vector<std::string> serial_emulator_command(const EmulatedBoard& board,
                                                 const std::string& image) {
  std::vector<std::string> command = emulator_command(board, image);
  // The multiplexer's buffer takes the bytes that come before the emulator notices that the board
  // hears. It has an escape byte; 256 is none.
  for (const char* argument :
       {"-chardev", "stdio,id=line,mux=on,signal=off", "-serial", "chardev:line", "-echr", "256"}) {
    command.emplace_back(argument);
  }
  return command;
}

std::vector<std::string> unit_emulator_command(const EmulatedBoard& board,
                                               const std::string& image) {
  std::vector<std::string> command{std::string(board.emulator)};
  command.insert(command.end(), board.machine_arguments.begin(), board.machine_arguments.end());
  // 2^n ns for an instruction.
  const char* const time = board.name == "netduinoplus2" ? "shift=3" : "shift=5";
  for (const char* argument :
       {"-display", "none", "-monitor", "none", "-serial", "pty", "-icount", time, "-kernel"}) {
    command.emplace_back(argument);
  }
  command.push_back(image);
  return command;
}

}  // namespace sonoglide::emulated
