/// From a configured controller to an image for a board.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/emulated/board_list.hpp"

namespace sonoglide::emulated {

/// Builds the image of a controller with the toolchain file of a board, out of the source tree that
/// this program was built from or, where the environment variable SONOGLIDE_SOURCE names one, out
/// of that. Ready images are kept under $XDG_CACHE_HOME/sonoglide or ~/.cache/sonoglide and found
/// again by what they are made of: header, board, sources, compiler. The name of each ends with a
/// hash of that and of the image: one that is cut short, or another, is removed and built anew.
///
/// @param header  as controller_header() writes it
/// @return the image, an ELF file
/// @throws process::ProcessError  the compiler, CMake or the sources are missing, a path is none
///         that CMake takes, or the build failed; what() says what to install, or has the build's
///         own words
std::filesystem::path build_image(const emulated::EmulatedBoard& board, const std::string& header);

}  // namespace sonoglide::emulated
