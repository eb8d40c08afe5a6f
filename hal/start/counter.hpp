/// Cost of a stretch of code, in a unit of the processor.
#pragma once

#include <cstdint>

extern "C" {

/// Lets the processor's counter run.
void start_counter();

/// Rises while the processor works, and wraps at 2^32. The difference of two counts is the cost.
std::uint32_t read_counter();
}
