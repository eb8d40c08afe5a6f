/// How an image ends: what a board offers to the start-up code.
#pragma once

extern "C" {

/// After main.
/// @param code  what main returned
[[noreturn]] void leave_image(int code);

/// On any exception or interrupt that is not expected: puts the board into a safe state.
[[noreturn]] void take_exception();

/// On the interrupt of the processor's system timer. An image that expects it defines it, for one as the
/// carrier's interrupt; in any other it is take_exception.
void take_system_tick();

/// On a non-maskable interrupt. A board on which it may be harmless defines it; on any other it is
/// take_exception.
void take_non_maskable_interrupt();
}
