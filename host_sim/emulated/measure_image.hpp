/// What an image costs before it runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "host_sim/emulated/board_list.hpp"
#include "host_sim/emulated/image_size.hpp"
#include "host_sim/emulated/stack_bound.hpp"
#include "host_sim/process/wait_for_input.hpp"

namespace sonoglide::emulated {

struct ImageCost {
  ImageSize size;
  /// From reset on, with one exception on top: none is expected, and the first one ends the image.
  StackBound stack;
};

/// @param attention  called now and then meanwhile
/// @throws process::ProcessError  the file is no image, or the board's binutils are missing
ImageCost measure_image(const std::filesystem::path& image, const emulated::EmulatedBoard& board,
                        const process::Attention& attention);

}  // namespace sonoglide::emulated
