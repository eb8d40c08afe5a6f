/// How an image ends: what a board offers to the start-up code.
#pragma once

extern "C" {

/// After main.
/// @param code  what main returned
[[noreturn]] void leave_image(int code);

/// On any exception or interrupt, since none is expected: puts the board into a safe state.
[[noreturn]] void take_exception();
}
