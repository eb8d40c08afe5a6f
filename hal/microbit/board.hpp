/// The micro:bit: its devices, and the boards that images are made for from them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/board/serial_link.hpp"
#include "hal/timed/board.hpp"

namespace sonoglide::hal::microbit {

// Serial line of the micro:bit, which its interface chip passes on to USB.

/// A byte link, see hal/board.hpp: 115200 baud, 8 data bits, no parity, one stop bit.
class Uart {
 public:
  static constexpr std::uint32_t baud = 115200;

  Uart();
  bool receive(std::uint8_t& byte);
  bool send(std::uint8_t byte);

 private:
  bool sending_ = false;
};

// TIMER0 of the nRF51, which has no SysTick.

/// Counts the crystal's 16 MHz, 32 bits, without an interrupt; the crystal must be running.
class Timer {
 public:
  static constexpr std::uint32_t hz = 16000000;
  static constexpr std::uint32_t largest = 0xffffffff;

  Timer();
  std::uint32_t ticks() const;
};

// Watchdog of the nRF51.

/// Resets the board 0.1 s after it was last fed. Once started it runs unchanged until a reset: also
/// while a page of flash is erased, which takes 22 ms. It counts the 32 kHz oscillator, which it
/// starts itself, and stands still under a debugger.
class Watchdog {
 public:
  Watchdog();
  void feed();
  bool caused_reset() const { return caused_reset_; }

 private:
  bool caused_reset_;
};

// Flash of the nRF51, through its non-volatile memory controller.

/// The last two pages for parameters, and the two before for the history, which the linker script keeps free of code. The processor stands still while
/// a page is erased (22 ms) or a word is programmed (46 us), because its code is in the same flash.
class Flash {
 public:
  static constexpr std::size_t page_words = 256;
  static constexpr std::size_t pages = 4;

  std::uint32_t read(std::size_t page, std::size_t word) const;
  void erase(std::size_t page);
  void program(std::size_t page, std::size_t word, std::uint32_t value);
  bool busy() const;
};

// What a unit that keeps its own time finds on a micro:bit.

struct TimedHardware {
  /// 16 MHz leave 266 clocks for each carrier period; software floating point takes thousands.
  static constexpr unsigned least_periods = 128;
  static constexpr std::uint32_t host_timeout_ms = 0;
  using ByteLink = Uart;  ///< first: it starts the crystal
  using Board = timed::Board<Timer>;
  using Watchdog = microbit::Watchdog;
  using Flash = microbit::Flash;
};

// A micro:bit in lockstep over its USB serial line.

using SerialBoard = lockstep::LockstepBoard<lockstep::SerialLink<Uart>>;

}  // namespace sonoglide::hal::microbit
