/// For a board that does not count what its answers cost.
#pragma once

#include <cstdint>

namespace sonoglide::hal::lockstep {

struct NoCounter {
  std::uint32_t read() const { return 0; }
};

}  // namespace sonoglide::hal::lockstep
