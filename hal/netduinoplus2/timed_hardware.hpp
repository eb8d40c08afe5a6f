/// What a unit that keeps its own time finds on a Netduino Plus 2.
#pragma once

#include "hal/cortex_m/sys_tick.hpp"
#include "hal/netduinoplus2/flash.hpp"
#include "hal/netduinoplus2/uart.hpp"
#include "hal/netduinoplus2/watchdog.hpp"
#include "hal/timed/board.hpp"

namespace sonoglide::hal::netduinoplus2 {

/// Erasing a flash sector stands still for longer than SysTick turns in, so that periods go
/// uncounted: only while parameters are saved, when the drive is at zero.
struct TimedHardware {
  /// The internal oscillator's 16 MHz leave 266 clocks for each carrier period.
  static constexpr unsigned carriers_per_period = 16;
  using ByteLink = Uart;
  using Board = timed::Board<cortex_m::ProcessorClock<16000000>>;
  using Watchdog = netduinoplus2::Watchdog;
  using Flash = netduinoplus2::Flash;
};

}  // namespace sonoglide::hal::netduinoplus2
