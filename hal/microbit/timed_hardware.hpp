/// What a unit that keeps its own time finds on a micro:bit.
#pragma once

#include "hal/microbit/flash.hpp"
#include "hal/microbit/timer.hpp"
#include "hal/microbit/uart.hpp"
#include "hal/microbit/watchdog.hpp"
#include "hal/timed/board.hpp"

namespace sonoglide::hal::microbit {

struct TimedHardware {
  /// 16 MHz leave 266 clocks for each carrier period; software floating point takes thousands.
  static constexpr unsigned carriers_per_period = 128;
  using ByteLink = Uart;  ///< first: it starts the crystal
  using Board = timed::Board<Timer>;
  using Watchdog = microbit::Watchdog;
  using Flash = microbit::Flash;
};

}  // namespace sonoglide::hal::microbit
