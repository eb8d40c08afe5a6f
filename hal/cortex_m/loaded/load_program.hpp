/// The start of an image that is copied to RAM before it runs.
#pragma once

/// Defined by the board, in the section .boot: runs from where the image is kept, before there is memory, and
/// calls nothing that is not there as well.
extern "C" void start_clocks();
