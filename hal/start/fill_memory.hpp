/// The first stage of every start, on whatever processor.
#pragma once

/// Gives static objects their first values: copies .data from ROM and clears .bss. Call it before
/// main, with a stack.
extern "C" void fill_memory();
