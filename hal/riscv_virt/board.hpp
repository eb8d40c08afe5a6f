/// QEMU's RISC-V virt: its devices, and the boards that images are made for from them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/board/serial_link.hpp"
#include "hal/no_watchdog.hpp"
#include "hal/timed/board.hpp"
#include "hal/timed/volatile_pages.hpp"

namespace sonoglide::hal::riscv_virt {

// Serial line of QEMU's RISC-V virt: an NS16550A.

/// A byte link, see hal/board.hpp: 115200 baud, 8 data bits, no parity, one stop bit.
class Uart {
 public:
  static constexpr std::uint32_t baud = 115200;

  Uart();
  bool receive(std::uint8_t& byte);
  bool send(std::uint8_t byte);
};

// Machine timer of QEMU's RISC-V virt.

/// Source: RISC-V Advanced Core Local Interruptor, MTIMER; address from memory.ld.
extern "C" volatile const std::uint32_t machine_time_low;

/// The low half of mtime, which runs since power-on.
class MachineTimer {
 public:
  static constexpr std::uint32_t hz = 10000000;
  static constexpr std::uint32_t largest = 0xffffffff;

  std::uint32_t ticks() const { return machine_time_low; }
};

// What a unit that keeps its own time finds on QEMU's RISC-V virt.

struct TimedHardware {
  static constexpr std::size_t trace_records = 1024;
  static constexpr unsigned least_periods = 16;
  static constexpr std::uint32_t host_timeout_ms = 0;
  using ByteLink = Uart;
  using Board = timed::Board<MachineTimer>;
  using Watchdog = NoWatchdog;
  using Flash = timed::VolatilePages;
};

// QEMU's RISC-V virt in lockstep over its serial line.

using SerialBoard = lockstep::LockstepBoard<lockstep::SerialLink<Uart>>;

}  // namespace sonoglide::hal::riscv_virt
