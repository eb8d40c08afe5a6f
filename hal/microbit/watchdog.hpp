/// Watchdog of the nRF51.
#pragma once

namespace sonoglide::hal::microbit {

/// Resets the board 0.1 s after it was last fed. Once started it runs unchanged until a reset: also
/// while a page of flash is erased, which takes 22 ms. It counts the 32 kHz oscillator, which it
/// starts itself, and stands still under a debugger.
class Watchdog {
 public:
  Watchdog();
  void feed();
  bool caused_reset() const { return caused_reset_; }

 private:
  bool caused_reset_;
};

}  // namespace sonoglide::hal::microbit
