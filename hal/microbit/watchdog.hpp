/// Watchdog of the nRF51.
#pragma once

namespace sonoglide::hal::microbit {

/// Resets the board a second after it was last fed; once started it runs until a reset. It counts
/// the 32 kHz oscillator, which it starts itself, and stands still under a debugger.
class Watchdog {
 public:
  Watchdog();
  void feed();
  bool caused_reset() const { return caused_reset_; }

 private:
  bool caused_reset_;
};

}  // namespace sonoglide::hal::microbit
