/// Waiting for another program without being deaf to whoever interrupts this one.
#pragma once

#include <chrono>
#include <functional>

namespace sonoglide::process {

/// Called a few times a second while waiting, and whenever a signal has come; what it throws ends
/// the wait.
using Attention = std::function<void()>;

/// @param limit  waits this long at most
/// @return whether there is something to read, the end included
bool wait_for_input(int descriptor, std::chrono::milliseconds limit, const Attention& attention);

}  // namespace sonoglide::process
