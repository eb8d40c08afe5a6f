/// The Netduino Plus 2: its devices, and the boards that images are made for from them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/cortex_m/sys_tick.hpp"
#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/board/serial_link.hpp"
#include "hal/timed/board.hpp"

namespace sonoglide::hal::netduinoplus2 {

// USART1 of the STM32F405, on pins PA9 (out) and PA10 (in).

/// A byte link, see hal/board.hpp: 115200 baud, 8 data bits, no parity, one stop bit.
class Uart {
 public:
  static constexpr std::uint32_t baud = 115200;

  Uart();
  bool receive(std::uint8_t& byte);
  bool send(std::uint8_t byte);
};

// Independent watchdog of the STM32F405.

/// Resets the board 0.1 s after it was last fed. Once started it runs until a reset. Its oscillator
/// has 17 to 47 kHz, so 0.1 s is 0.07 to 0.19 s. The erase of a flash sector takes longer; for it
/// Flash sets the watchdog to 8 s (5.5 to 15.5 s), with the drive at zero.
class Watchdog {
 public:
  Watchdog();
  static void feed();
  /// These feed the watchdog, which then waits 8 s or 0.1 s; it must have been started.
  static void wait_long();
  static void wait_short();
  bool caused_reset() const { return caused_reset_; }

 private:
  bool caused_reset_;
};

// Flash of the STM32F405.

/// The first 256 bytes of the last two sectors of 128 KiB, which the linker script keeps free of
/// code. An erase takes 1 to 2 s, at most 4 s. The processor stands still meanwhile, because its
/// code is in the same flash. So the watchdog, which must have been started, is made to wait. The
/// controller of the flash is locked except during an operation. The data cache must be off, as it
/// is after a reset.
class Flash {
 public:
  static constexpr std::size_t page_words = 64;

  std::uint32_t read(std::size_t page, std::size_t word) const;
  void erase(std::size_t page);
  void program(std::size_t page, std::size_t word, std::uint32_t value);
  bool busy() const;
};

// What a unit that keeps its own time finds on a Netduino Plus 2.

/// The erase of a flash sector takes longer than SysTick takes to wrap, so that periods go
/// uncounted. This happens only while parameters are saved, with the drive at zero.
struct TimedHardware {
  static constexpr std::size_t trace_records = 1024;
  /// The internal oscillator's 16 MHz leave 266 clocks for each carrier period.
  static constexpr unsigned least_periods = 16;
  static constexpr std::uint32_t host_timeout_ms = 0;
  using ByteLink = Uart;
  using Board = timed::Board<cortex_m::ProcessorClock<16000000>>;
  using Watchdog = netduinoplus2::Watchdog;
  using Flash = netduinoplus2::Flash;
};

// A Netduino Plus 2 in lockstep over USART1.

using SerialBoard = lockstep::LockstepBoard<lockstep::SerialLink<Uart>>;

}  // namespace sonoglide::hal::netduinoplus2
