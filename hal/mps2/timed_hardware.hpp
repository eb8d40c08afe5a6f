/// What a unit that keeps its own time finds on an MPS2 with the Cortex-M3, M4 or M7.
#pragma once

#include <cstdint>

#include "hal/cortex_m/sys_tick.hpp"
#include "hal/mps2/uart.hpp"
#include "hal/mps2/watchdog.hpp"
#include "hal/timed/board.hpp"
#include "hal/timed/volatile_pages.hpp"

namespace sonoglide::hal::mps2 {

struct TimedHardware {
  static constexpr std::uint32_t clock_hz = 25000000;
  /// 25 MHz leave 416 clocks for each carrier period.
  static constexpr unsigned carriers_per_period = 16;
  using ByteLink = Uart<clock_hz>;
  using Board = timed::Board<cortex_m::ProcessorClock<clock_hz>>;
  using Watchdog = mps2::Watchdog<clock_hz>;
  using Flash = timed::VolatilePages;
};

}  // namespace sonoglide::hal::mps2
