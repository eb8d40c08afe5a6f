/// Boards as options of commands.
#pragma once

#include <string>

#include "host_sim/emulated/board_list.hpp"

namespace sonoglide::cli {

/// @return empty for the name of a board, else what is wrong with it
std::string check_board(const std::string& name);

/// What would stop the run later stops it before anything is built.
/// @throws process::ProcessError  the board's emulator is not installed
void require_emulator(const emulated::EmulatedBoard& board);

}  // namespace sonoglide::cli
