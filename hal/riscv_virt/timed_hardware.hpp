/// What a unit that keeps its own time finds on QEMU's RISC-V virt.
#pragma once

#include "hal/no_watchdog.hpp"
#include "hal/riscv_virt/machine_timer.hpp"
#include "hal/riscv_virt/uart.hpp"
#include "hal/timed/board.hpp"
#include "hal/timed/volatile_pages.hpp"

namespace sonoglide::hal::riscv_virt {

struct TimedHardware {
  static constexpr unsigned carriers_per_period = 16;
  using ByteLink = Uart;
  using Board = timed::Board<MachineTimer>;
  using Watchdog = NoWatchdog;
  using Flash = timed::VolatilePages;
};

}  // namespace sonoglide::hal::riscv_virt
