/// Every sample must be usable.
#pragma once

namespace sonoglide::control {

struct StrictSamples {
  struct Parameters {};

  explicit StrictSamples(const Parameters&) {}
  static constexpr void restart() {}
  /// @return whether the controller may go on
  static constexpr bool accept(bool usable) { return usable; }
};

}  // namespace sonoglide::control
