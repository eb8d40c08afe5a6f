/// Independent watchdog of the STM32F405.
#pragma once

namespace sonoglide::hal::netduinoplus2 {

/// Resets the board 0.1 s after it was last fed. Once started it runs until a reset. Its oscillator
/// has 17 to 47 kHz, so 0.1 s is 0.07 to 0.19 s. The erase of a flash sector takes longer; for it
/// Flash sets the watchdog to 8 s (5.5 to 15.5 s), with the drive at zero.
class Watchdog {
 public:
  Watchdog();
  static void feed();
  /// These feed the watchdog, which then waits 8 s or 0.1 s; it must have been started.
  static void wait_long();
  static void wait_short();
  bool caused_reset() const { return caused_reset_; }

 private:
  bool caused_reset_;
};

}  // namespace sonoglide::hal::netduinoplus2
