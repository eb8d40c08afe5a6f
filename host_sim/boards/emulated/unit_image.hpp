/// The image of a unit: for which boards it is built, and what a board is loaded from.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::emulated {

/// A kind of file that a board is loaded from.
struct UnitFile {
  std::string_view ending;  ///< with its dot
  std::string_view before;  ///< of the command that loads it: what comes before the file,
  std::string_view after;   ///< and behind it
  /// `program`, the file and what is behind it are one word: a script in Tcl.
  bool in_script = false;
};

struct UnitBoard : ImageBoard {
  std::string_view image_suffix;   ///< see build_image()
  bool is_emulated;                ///< one of emulated_boards()
  std::vector<UnitFile> files;     ///< the usual one first
  std::string_view uf2_chip = {};  ///< as hal/pico/write_uf2 calls it, where there is such a file
  std::string_view carriers = {};  ///< fixed frequencies that it makes, as its page has them
  bool reads_encoder = false;      ///< along the sliding

  /// @return the kind of a file's ending, or null
  const UnitFile* file(std::string_view ending) const;
};

/// Every board with a timer of its own: those of a product first, then those of emulated_boards().
const std::vector<UnitBoard>& unit_boards();

/// @return the board of that name, or null
const UnitBoard* find_unit_board(std::string_view name);

/// @throws configure::ConfigurationError  the scene asks for what no unit, or none on this board, has
void require_unit(const scene::Scene& scene, const UnitBoard& board);

/// As build_image().
/// @throws configure::ConfigurationError  the image itself refuses the scene when it is compiled, or
///         is too large for the board
/// @throws process::ProcessError  as build_image()
std::filesystem::path build_unit(const UnitBoard& board, const std::string& header,
                                 double encoder_counts_per_m = 0.0);

/// The content of a file that the board is loaded from.
/// @param image   an ELF file
/// @param ending  of one of board.files
/// @throws process::ProcessError  a tool is missing
std::string unit_file(const UnitBoard& board, const std::filesystem::path& image,
                      std::string_view ending);

}  // namespace sonoglide::emulated
