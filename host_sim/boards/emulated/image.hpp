/// An image for a board: built from a configured controller, and what it takes before it runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::emulated {

// How deep the stack of an image can get.

/// Either a bound, or why there is none.
struct StackBound {
  std::uint64_t bytes = 0;
  std::string unbounded_by;  ///< empty, or what calls itself, is called indirectly or grows freely
};

/// The deepest path through the calls of a disassembled image. A function counts with all that it
/// may put on the stack, whatever way is taken through it.
///
/// It is read from the image's own instructions, so that start-up code and the compiler's library
/// are in it. A call through a pointer, a recursion and a frame of variable size leave no bound.
///
/// @param disassembly  as GNU objdump -d prints it, for Thumb or RISC-V
/// @param entry        the function that the path begins with
StackBound stack_bound(const std::string& disassembly, const std::string& entry);

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
ImageCost measure_image(const std::filesystem::path& image, const ImageBoard& board);

/// The bytes of a file; none where it cannot be read.
std::string content(const std::filesystem::path& path);

// From a configured controller to an image for a board.

/// The source tree that images are built out of, see build_image().
/// @throws process::ProcessError  there is none
std::filesystem::path source_tree();

/// Builds the image of a controller with the toolchain file of a board, out of the source tree that
/// this program was built from or, where the environment variable SONOGLIDE_SOURCE names one, out
/// of that. Ready images are kept under $XDG_CACHE_HOME/sonoglide or ~/.cache/sonoglide and found
/// again by what they are made of: header, board, encoder, sources, compiler. The name of each ends with a
/// hash of that and of the image: one that is cut short, or another, is removed and built anew.
///
/// @param suffix  which of the board's images: tools/cmake/boards.cmake adds it to the controller's name
/// @param header  as controller_header() writes it
/// @param encoder_counts_per_m  of the encoder that the board reads; 0: none
/// @return the image, an ELF file
/// @throws process::ProcessError  the compiler, CMake or the sources are missing, a path is none
///         that CMake takes, or the build failed; what() says what to install, or has the build's
///         own words
std::filesystem::path build_image(const ImageBoard& board, std::string_view suffix,
                                  const std::string& header, double encoder_counts_per_m = 0.0);

/// The command that runs one of a board's programs for node.
/// @throws process::ProcessError  node lacks the package that emulates the board
std::vector<std::string> node_command(const emulated::EmulatedBoard& board,
                                      std::string_view program);

/// The command that runs such an image, in lockstep over standard input and output.
/// @throws process::ProcessError  node lacks the package that emulates the board
std::vector<std::string> run_command(const emulated::EmulatedBoard& board,
                                     const std::filesystem::path& image);

}  // namespace sonoglide::emulated
