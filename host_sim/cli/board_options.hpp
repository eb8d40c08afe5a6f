/// Boards as options of commands.
#pragma once

#include <string>

#include "host_sim/emulated/board_list.hpp"

namespace sonoglide::cli {

/// @return empty for the name of a board in lockstep over semihosting, else what is wrong with it
std::string check_board(const std::string& name);

/// The same of those too that make the carrier themselves.
std::string check_any_board(const std::string& name);

/// The same of those that a unit is built for.
std::string check_unit_board(const std::string& name);

/// What would stop the run later stops it before anything is built.
/// @throws process::ProcessError  the board's emulator, or a package of it, is not installed
void require_emulator(const emulated::EmulatedBoard& board);

}  // namespace sonoglide::cli
