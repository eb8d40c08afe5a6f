/// The compiler and its binutils for a board.
#pragma once

#include <string>

#include "host_sim/emulated/board_list.hpp"

namespace sonoglide::emulated {

struct CrossTools {
  std::string prefix;   ///< of every program's name
  std::string package;  ///< of Debian, that has the compiler
};

inline CrossTools cross_tools(const emulated::EmulatedBoard& board) {
  return board.toolchain.substr(0, 4) == "arm-"
             ? CrossTools{"arm-none-eabi-", "gcc-arm-none-eabi"}
             : CrossTools{"riscv64-unknown-elf-", "gcc-riscv64-unknown-elf"};
}

}  // namespace sonoglide::emulated
