/// The one instruction sequence by which a processor calls its debugger or emulator.
#pragma once

#include <cstdint>

namespace sonoglide::hal::semihosting {

/// @param operation   number of the system call
/// @param parameters  its block of 32-bit words
/// @return what the call answers
std::int32_t trap(std::int32_t operation, const std::uintptr_t* parameters);

}  // namespace sonoglide::hal::semihosting
