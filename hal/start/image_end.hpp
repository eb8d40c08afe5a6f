/// How an image ends: what a board offers to the start-up code.
#pragma once

extern "C" {

/// Switches the drive off, at once. Whatever ends an image calls it, in the end again and again; a unit whose image is
/// damaged calls it once, before its first carrier period. It needs neither
/// stack nor static data, because an exception may come from there being none: it calls nothing and writes
/// registers of the board.
void shutdown();

/// After main: calls shutdown() and stays there.
/// @param code  what main returned
[[noreturn]] void leave_image(int code);

/// On any exception or interrupt that is not expected: calls shutdown() and stays there. An image that asks for
/// kept exceptions (hal/exception) writes each of them down before.
[[noreturn]] void take_exception();

/// On the interrupt of the processor's system timer. An image that expects it defines it, for one as the
/// carrier's interrupt; in any other it is as any other exception.
void take_system_tick();

/// On a hard fault, and on a non-maskable interrupt, which may be harmless on a board. One that defines them has
/// them; on any other they are as any other exception.
void take_hard_fault();
void take_non_maskable_interrupt();
}
