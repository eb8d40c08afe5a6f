/// TIMER0 of the nRF51, which has no SysTick.
#pragma once

#include <cstdint>

namespace sonoglide::hal::microbit {

/// Counts the crystal's 16 MHz, 32 bits, without an interrupt; the crystal must be running.
class Timer {
 public:
  static constexpr std::uint32_t hz = 16000000;
  static constexpr std::uint32_t largest = 0xffffffff;

  Timer();
  std::uint32_t ticks() const;
};

}  // namespace sonoglide::hal::microbit
