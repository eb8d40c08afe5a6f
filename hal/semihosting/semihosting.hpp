/// System calls of a board to the emulator or debugger that it runs under.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::semihosting {

/// How an image ends; what the emulator's process returns.
enum class ExitCode : std::uint32_t {
  shut_down = 0,        ///< the host closed the link between two frames
  link_broken = 1,      ///< a frame was cut short, out of turn, or could not be sent
  processor_fault = 2,  ///< an exception was taken; none is expected
};

/// Opens the emulator's standard input or output.
/// @return a handle, negative on failure
std::int32_t open_standard_input();
std::int32_t open_standard_output();

/// Reads until `size` bytes have come or the input has ended.
/// @return how many bytes came
std::size_t read_all(std::int32_t handle, void* bytes, std::size_t size);

/// @return whether every byte was taken
bool write_all(std::int32_t handle, const void* bytes, std::size_t size);

[[noreturn]] void leave(ExitCode code);

}  // namespace sonoglide::hal::semihosting
