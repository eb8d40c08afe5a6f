/// The imagined microcontroller as a unit, with parameters and a link to its host: what it has beside the carrier.
/// Put a driver of the real one in the place of each part; a part that the board lacks stays as it is.
#pragma once

#include <cstdint>

#include "hal/no_watchdog.hpp"
#include "hal/template/board.hpp"
#include "hal/timed/volatile_pages.hpp"

namespace sonoglide::hal::template_board {

/// A UART with a queue in either direction.
struct UartRegisters {
  volatile std::uint32_t received_count;  ///< bytes that wait
  volatile std::uint32_t received;        ///< the oldest of them, which is then gone
  volatile std::uint32_t room;            ///< bytes that may be sent
  volatile std::uint32_t sent;
};

extern "C" UartRegisters uart;  ///< address from memory.ld

/// A byte link, see hal/board.hpp.
class Uart {
 public:
  static constexpr std::uint32_t baud = 115200;

  bool receive(std::uint8_t& byte) {
    const bool there = uart.received_count != 0;
    if (there) {
      byte = static_cast<std::uint8_t>(uart.received);
    }
    return there;
  }

  bool send(std::uint8_t byte) {
    const bool room = uart.room != 0;
    if (room) {
      uart.sent = byte;
    }
    return room;
  }
};

/// The carrier at a period that the image asks for.
class UnitBoard : public Board {
 public:
  static constexpr std::uint32_t clock_hz = 100000000;
  static constexpr std::uint32_t most_period_ticks = 0xffff;

  /// @param period_ticks  clocks in a carrier period
  explicit UnitBoard(std::uint32_t period_ticks) { carrier.period_ticks = period_ticks; }

  std::uint32_t period() const { return carrier.periods; }
};

struct Hardware {
  static constexpr unsigned least_periods = 1;
  static constexpr std::uint32_t host_timeout_ms = 100;
  using ByteLink = Uart;
  using Board = UnitBoard;
  using Watchdog = NoWatchdog;
  using Flash = timed::VolatilePages;
};

}  // namespace sonoglide::hal::template_board
