/// Independent watchdog of the STM32F405.
#pragma once

namespace sonoglide::hal::netduinoplus2 {

/// Resets the board 0.1 s after it was last fed, and once started runs until a reset. Its
/// oscillator has 17 to 47 kHz: 0.07 to 0.19 s. A flash sector takes longer to erase; Flash makes
/// it wait 8 s (5.5 to 15.5 s) for that, when the drive is at zero.
class Watchdog {
 public:
  Watchdog();
  static void feed();
  /// Feeds it, and it waits 8 s, or 0.1 s again; it must have been started.
  static void wait_long();
  static void wait_short();
  bool caused_reset() const { return caused_reset_; }

 private:
  bool caused_reset_;
};

}  // namespace sonoglide::hal::netduinoplus2
