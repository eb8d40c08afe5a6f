/// The MPS2 boards: their devices, and the boards that images are made for from them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/cortex_m/sys_tick.hpp"
#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/board/serial_link.hpp"
#include "hal/timed/board.hpp"
#include "hal/timed/volatile_pages.hpp"

namespace sonoglide::hal::mps2 {

// Serial line of the MPS2 boards.

/// Source: Arm, Cortex-M System Design Kit, Technical Reference Manual, APB UART.
struct UartRegisters {
  volatile std::uint32_t data;
  volatile std::uint32_t state;
  volatile std::uint32_t control;
  volatile std::uint32_t interrupts;
  volatile std::uint32_t baud_divider;
};

extern "C" UartRegisters uart0;  ///< address from the linker script

/// A byte link, see hal/board.hpp: 115200 baud, 8 data bits, no parity, one stop bit.
template <std::uint32_t ClockHz>
class Uart {
 public:
  static constexpr std::uint32_t baud = 115200;

  Uart() {
    uart0.baud_divider = ClockHz / baud;
    uart0.control = transmit_enabled | receive_enabled;
  }

  bool receive(std::uint8_t& byte) {
    const bool there = (uart0.state & receive_full) != 0;
    if (there) {
      byte = static_cast<std::uint8_t>(uart0.data);
    }
    return there;
  }

  bool send(std::uint8_t byte) {
    const bool room = (uart0.state & transmit_full) == 0;
    if (room) {
      uart0.data = byte;
    }
    return room;
  }

 private:
  enum Control : std::uint32_t { transmit_enabled = 1, receive_enabled = 2 };
  enum State : std::uint32_t { transmit_full = 1, receive_full = 2 };
};

// Whether the watchdog caused the last reset of an MPS2 board.

// Addresses from the linker script.
extern "C" {
extern volatile std::uint32_t reset_information;  ///< CMSDK system controller, RSTINFO
extern volatile std::uint32_t reset_syndrome;     ///< SSE-200 system control, RESET_SYNDROME
}

/// Cortex-M3, M4 and M7. Source: Arm, Cortex-M System Design Kit, Technical Reference Manual.
struct ResetInformation {
  /// Returns whether it was the watchdog, and clears the record.
  static bool take_watchdog() {
    constexpr std::uint32_t by_watchdog = 1U << 1;
    const bool caused = (reset_information & by_watchdog) != 0;
    reset_information = by_watchdog;  // a set bit clears it
    return caused;
  }
};

/// Cortex-M33. Source: Arm, CoreLink SSE-200 Subsystem, Technical Reference Manual.
struct ResetSyndrome {
  /// Returns whether it was the watchdog, and clears the record.
  static bool take_watchdog() {
    constexpr std::uint32_t by_secure_watchdog = 1U << 2;
    const bool caused = (reset_syndrome & by_secure_watchdog) != 0;
    reset_syndrome = reset_syndrome & ~by_secure_watchdog;
    return caused;
  }
};

// Watchdog of the MPS2 boards.

/// Source: Arm, Cortex-M System Design Kit, Technical Reference Manual, APB watchdog.
struct WatchdogRegisters {
  volatile std::uint32_t load;
  volatile std::uint32_t value;
  volatile std::uint32_t control;
  volatile std::uint32_t clear;
};

// Addresses from the linker script.
extern "C" {
extern WatchdogRegisters watchdog;
extern volatile std::uint32_t watchdog_lock;
}

/// If it is not fed for a tenth of a second, it raises the NMI, which ends the image. Another tenth
/// later it resets the board.
///
/// @tparam ResetCause  offers bool take_watchdog(), whether the watchdog caused the last reset
template <std::uint32_t ClockHz, class ResetCause>
class Watchdog {
 public:
  Watchdog() : caused_reset_(ResetCause::take_watchdog()) {
    watchdog_lock = unlock_word;
    watchdog.load = ClockHz / 10;
    watchdog.control = counting | resetting;
  }

  void feed() { watchdog.clear = 1; }
  bool caused_reset() const { return caused_reset_; }

 private:
  enum Control : std::uint32_t { counting = 1, resetting = 2 };
  static constexpr std::uint32_t unlock_word = 0x1acce551;

  bool caused_reset_;
};

// What a unit that keeps its own time finds on an MPS2 board.

template <std::uint32_t ClockHz, class ResetCause>
struct TimedHardware {
  static constexpr std::size_t trace_records = 1024;
  /// 25 MHz leave 416 clocks for each carrier period, 20 MHz 333.
  static constexpr unsigned least_periods = 16;
  static constexpr std::uint32_t host_timeout_ms = 0;
  using ByteLink = Uart<ClockHz>;
  using Board = timed::Board<cortex_m::ProcessorClock<ClockHz>>;
  using Watchdog = mps2::Watchdog<ClockHz, ResetCause>;
  using Flash = timed::VolatilePages;
};

using An385TimedHardware = TimedHardware<25000000, ResetInformation>;  ///< AN386 and AN500 as well
using An505TimedHardware = TimedHardware<20000000, ResetSyndrome>;

// An MPS2 board in lockstep over UART0.

template <std::uint32_t ClockHz>
using SerialBoard = lockstep::LockstepBoard<lockstep::SerialLink<Uart<ClockHz>>>;

using An385SerialBoard = SerialBoard<25000000>;  ///< AN386 and AN500 as well
using An505SerialBoard = SerialBoard<20000000>;

}  // namespace sonoglide::hal::mps2
