/// What an image takes of a board before it runs: flash, RAM and stack.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "host_sim/emulated/board_list.hpp"
#include "host_sim/emulated/stack_bound.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::emulated {

struct ImageSize {
  std::uint64_t flash_bytes = 0;  ///< code, constants, initial values
  std::uint64_t ram_bytes = 0;    ///< static: initialised and cleared; no stack
};

/// @param elf  a 32-bit ELF file, little-endian
/// @throws process::ProcessError  it is none
ImageSize image_size(std::string_view elf);

/// What a processor puts on the stack by itself when it takes an exception, worst case.
/// @param elf  as above
std::uint64_t exception_frame_bytes(std::string_view elf);

struct ImageCost {
  ImageSize size;
  /// From reset on, with one exception on top: none is expected, and the first one ends the image.
  StackBound stack;
};

/// @throws process::ProcessError  the file is no image, or the board's binutils are missing
ImageCost measure_image(const std::filesystem::path& image, const emulated::EmulatedBoard& board);

}  // namespace sonoglide::emulated
