/// Independent watchdog of the STM32F405.
#pragma once

namespace sonoglide::hal::netduinoplus2 {

/// Resets the board some 8 s after it was last fed (its oscillator has 17 to 47 kHz: 5 to 16 s),
/// longer than a flash sector takes to erase; once started it runs until a reset.
class Watchdog {
 public:
  Watchdog();
  void feed();
  bool caused_reset() const { return caused_reset_; }

 private:
  bool caused_reset_;
};

}  // namespace sonoglide::hal::netduinoplus2
