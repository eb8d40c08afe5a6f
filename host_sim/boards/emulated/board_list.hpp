/// The boards that an image is built for and an emulator stands in for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sonoglide::emulated {

/// What an image is built for.
struct ImageBoard {
  std::string_view name;         ///< of the board, its configure preset and its images' folder
  std::string_view core;         ///< for a reader
  std::string_view toolchain;    ///< file in tools/toolchains, without its ending
  bool computes_double = false;  ///< its floating-point unit does, so that float64 can be built
  bool computes_single = true;   ///< fast enough for float32 in a carrier period
};

struct EmulatedBoard : ImageBoard {
  std::string_view emulator;                        ///< program, to be found in PATH
  std::vector<std::string_view> machine_arguments;  ///< what makes the emulator this board
  double counts_per_instruction;       ///< unit of a drive frame's count, under emulator_command()
  std::string_view image_suffix = {};  ///< of what runs in lockstep, see build_image()
};

/// Every board in lockstep over semihosting, from the smallest core to the largest, the other instruction
/// set last.
const std::vector<EmulatedBoard>& emulated_boards();

/// Boards whose image makes the carrier itself, and reads the converters and drives the bridge of its emulator,
/// a program for node. Their counts are clocks.
const std::vector<EmulatedBoard>& carrier_boards();

/// @return the board of that name among both, or null
const EmulatedBoard* find_board(std::string_view name);

/// The command that runs an image of emulated_boards() in lockstep: semihosting joined to the emulator's standard input
/// and output, no window, no device that the board does not have. The emulator's time passes with
/// the instructions: the same run counts the same.
std::vector<std::string> emulator_command(const EmulatedBoard& board, const std::string& image);

/// The same with the board's first serial line joined to standard input and output instead, every
/// byte as it is; semihosting still carries the exit code.
std::vector<std::string> serial_emulator_command(const EmulatedBoard& board,
                                                 const std::string& image);

/// The command that runs the image of a unit on the board's own timer, its serial line at a pseudo-terminal that
/// the emulator names. Its processor is fast enough for a step in time.
std::vector<std::string> unit_emulator_command(const EmulatedBoard& board,
                                               const std::string& image);

struct CrossTools {
  std::string prefix;   ///< of every program's name
  std::string package;  ///< of Debian, that has the compiler
};

inline CrossTools cross_tools(const ImageBoard& board) {
  return board.toolchain.substr(0, 4) == "arm-"
             ? CrossTools{"arm-none-eabi-", "gcc-arm-none-eabi"}
             : CrossTools{"riscv64-unknown-elf-", "gcc-riscv64-unknown-elf"};
}

}  // namespace sonoglide::emulated
