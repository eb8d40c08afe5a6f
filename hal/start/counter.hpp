/// What a stretch of code costs, in a unit of the processor's own.
#pragma once

#include <cstdint>

extern "C" {

/// Lets the processor's counter run.
void start_counter();

/// Rises while the processor works and wraps at 2^32: a difference of two counts is a stretch.
std::uint32_t read_counter();
}
