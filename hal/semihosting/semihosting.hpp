/// System calls of a board to the emulator or debugger that it runs under.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::semihosting {

/// The one instruction sequence by which a processor calls its debugger or emulator.
/// @param operation   number of the system call
/// @param parameters  its block of 32-bit words
/// @return what the call answers
std::int32_t trap(std::int32_t operation, const std::uintptr_t* parameters);

/// Opens the emulator's standard input or output.
/// @return a handle, negative on failure
std::int32_t open_standard_input();
std::int32_t open_standard_output();

/// Reads until `size` bytes have come or the input has ended.
/// @return how many bytes came
std::size_t read_all(std::int32_t handle, void* bytes, std::size_t size);

/// @return whether every byte was taken
bool write_all(std::int32_t handle, const void* bytes, std::size_t size);

/// Ends the emulator's process, or stops at the debugger.
/// @param code  the exit code of the process
[[noreturn]] void leave(int code);

}  // namespace sonoglide::hal::semihosting
