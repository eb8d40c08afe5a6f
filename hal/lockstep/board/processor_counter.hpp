/// The processor's counter, as a board in lockstep uses it.
#pragma once

#include <cstdint>

#include "hal/start/counter.hpp"

namespace sonoglide::hal::lockstep {

/// Runs from its construction on.
class ProcessorCounter {
 public:
  ProcessorCounter() { start_counter(); }
  std::uint32_t read() const { return read_counter(); }
};

}  // namespace sonoglide::hal::lockstep
