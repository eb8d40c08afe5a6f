/// Whose bytes an image is made of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "host_sim/boards/emulated/board_list.hpp"

namespace sonoglide::budget {

/// Bytes of flash by the source file that they were compiled from, inlined or not: code by the line
/// table, constants by their symbol's namespace. What has neither, the compiler's library and
/// padding, stands under "".
using FileBytes = std::map<std::string, std::uint64_t>;

/// Bytes of the parts of an image; their sum is that of the image.
struct Parts {
  std::uint64_t controller = 0;   ///< control, friction and numeric
  std::uint64_t application = 0;  ///< app, and what a scene configures
  std::uint64_t board = 0;        ///< hal
  std::uint64_t library = 0;      ///< of the compiler; padding
};

/// What each part keeps while the image runs, on the stack of main.
struct StateBytes {
  std::uint64_t controller = 0;
  std::uint64_t application = 0;
  std::uint64_t board = 0;
};

struct ImageParts {
  FileBytes files;
  Parts flash;
  StateBytes state;
  std::string names;  ///< of its symbols and of its functions, inlined or not, demangled
};

/// @param flash_bytes  of the whole image
/// @throws process::ProcessError  the file is no image, or the board's binutils are missing
ImageParts image_parts(const emulated::EmulatedBoard& board, const std::filesystem::path& image,
                       std::uint64_t flash_bytes);

}  // namespace sonoglide::budget
