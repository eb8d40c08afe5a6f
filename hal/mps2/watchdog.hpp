/// Watchdog of the MPS2 boards.
#pragma once

#include <cstdint>

namespace sonoglide::hal::mps2 {

/// Source: Arm, Cortex-M System Design Kit, Technical Reference Manual, APB watchdog.
struct WatchdogRegisters {
  volatile std::uint32_t load;
  volatile std::uint32_t value;
  volatile std::uint32_t control;
  volatile std::uint32_t clear;
};

// Addresses from the linker script.
extern "C" {
extern WatchdogRegisters watchdog;
extern volatile std::uint32_t watchdog_lock;
}

/// If it is not fed for a tenth of a second, it raises the NMI, which ends the image. Another tenth
/// later it resets the board.
///
/// @tparam ResetCause  offers bool take_watchdog(), whether the watchdog caused the last reset
template <std::uint32_t ClockHz, class ResetCause>
class Watchdog {
 public:
  Watchdog() : caused_reset_(ResetCause::take_watchdog()) {
    watchdog_lock = unlock_word;
    watchdog.load = ClockHz / 10;
    watchdog.control = counting | resetting;
  }

  void feed() { watchdog.clear = 1; }
  bool caused_reset() const { return caused_reset_; }

 private:
  enum Control : std::uint32_t { counting = 1, resetting = 2 };
  static constexpr std::uint32_t unlock_word = 0x1acce551;

  bool caused_reset_;
};

}  // namespace sonoglide::hal::mps2
