/// A board without a watchdog.
#pragma once

namespace sonoglide::hal {

struct NoWatchdog {
  static void feed() {}
  static constexpr bool caused_reset() { return false; }
};

}  // namespace sonoglide::hal
