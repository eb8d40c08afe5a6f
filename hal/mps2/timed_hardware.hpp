/// What a unit that keeps its own time finds on an MPS2 board.
#pragma once

#include <cstdint>

#include "hal/cortex_m/sys_tick.hpp"
#include "hal/mps2/reset_cause.hpp"
#include "hal/mps2/uart.hpp"
#include "hal/mps2/watchdog.hpp"
#include "hal/timed/board.hpp"
#include "hal/timed/volatile_pages.hpp"

namespace sonoglide::hal::mps2 {

template <std::uint32_t ClockHz, class ResetCause>
struct TimedHardware {
  /// 25 MHz leave 416 clocks for each carrier period, 20 MHz 333.
  static constexpr unsigned carriers_per_period = 16;
  using ByteLink = Uart<ClockHz>;
  using Board = timed::Board<cortex_m::ProcessorClock<ClockHz>>;
  using Watchdog = mps2::Watchdog<ClockHz, ResetCause>;
  using Flash = timed::VolatilePages;
};

using An385TimedHardware = TimedHardware<25000000, ResetInformation>;  ///< AN386 and AN500 as well
using An505TimedHardware = TimedHardware<20000000, ResetSyndrome>;

}  // namespace sonoglide::hal::mps2
