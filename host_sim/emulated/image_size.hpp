/// What an image takes of a board's memory.
#pragma once

#include <cstdint>
#include <string_view>

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

}  // namespace sonoglide::emulated
