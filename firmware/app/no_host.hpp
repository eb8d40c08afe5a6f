/// A unit that nobody talks to.
#pragma once

#include <cstdint>

namespace sonoglide::app {

/// Nobody can ask for a start, and no silence ends the drive.
struct NoHost {
  static constexpr bool drives_from_power_on = true;

  static constexpr bool falling() { return false; }
  static constexpr std::int32_t next() { return 0; }
  static void clear() {}
};

}  // namespace sonoglide::app
