/// What an image does first of all after a reset.
#pragma once

extern "C" {

/// An image that defines it has it called before anything else: before static objects have their values, before a
/// board starts its clocks and copies the program to RAM. For a watchdog, clocks, or memory with check bits that is
/// to be written before it is read. In any other image nothing is called, and nothing is linked.
///
/// There is a stack. It uses neither static objects, but for .noinit, nor floating point, and it calls nothing of a
/// library. It is in section .boot, and all that it calls (`[[gnu::section(".boot")]]`): where the image is kept.
void begin_reset();
}
