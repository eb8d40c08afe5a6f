/// Boards as options of commands.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/unit_image.hpp"
#include "host_sim/cli/options.hpp"

namespace sonoglide::cli {

/// @return empty for the name of a board in lockstep over semihosting, else what is wrong with it
std::string check_board(const std::string& name);

/// The same of those too that make the carrier themselves.
std::string check_any_board(const std::string& name);

/// The same of those that a unit is built for.
std::string check_unit_board(const std::string& name);

/// The header that the image of a scene's unit is built from.
/// @throws scene_file::SceneError  the scene has no controller, or asks for what no unit on this board has
std::string unit_header(const SceneInput& input, const experiment::Experiment& experiment,
                        const emulated::UnitBoard& board);

/// The command that loads a board from a file of this kind, or runs it in its emulator: a line for a shell,
/// whatever the file's name.
std::string load_command(const emulated::UnitFile& kind, const std::filesystem::path& path);

/// A path as it is told: no program takes it for an option.
std::string shown_path(const std::filesystem::path& path);

/// What would stop the run later stops it before anything is built.
/// @throws process::ProcessError  the board's emulator, or a package of it, is not installed
void require_emulator(const emulated::EmulatedBoard& board);

}  // namespace sonoglide::cli
