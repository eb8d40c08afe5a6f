/// What a unit that keeps its own time finds on a Netduino Plus 2.
#pragma once

#include "hal/cortex_m/sys_tick.hpp"
#include "hal/netduinoplus2/flash.hpp"
#include "hal/netduinoplus2/uart.hpp"
#include "hal/netduinoplus2/watchdog.hpp"
#include "hal/timed/board.hpp"

namespace sonoglide::hal::netduinoplus2 {

/// The erase of a flash sector takes longer than SysTick takes to wrap, so that periods go
/// uncounted. This happens only while parameters are saved, with the drive at zero.
struct TimedHardware {
  /// The internal oscillator's 16 MHz leave 266 clocks for each carrier period.
  static constexpr unsigned carriers_per_period = 16;
  using ByteLink = Uart;
  using Board = timed::Board<cortex_m::ProcessorClock<16000000>>;
  using Watchdog = netduinoplus2::Watchdog;
  using Flash = netduinoplus2::Flash;
};

}  // namespace sonoglide::hal::netduinoplus2
