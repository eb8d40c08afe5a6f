/// The counter of a board that does not measure the cost of its answers.
#pragma once

#include <cstdint>

namespace sonoglide::hal::lockstep {

struct NoCounter {
  std::uint32_t read() const { return 0; }
};

}  // namespace sonoglide::hal::lockstep
