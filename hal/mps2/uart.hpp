/// Serial line of the MPS2 boards.
#pragma once

#include <cstdint>

namespace sonoglide::hal::mps2 {

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
  Uart() {
    uart0.baud_divider = ClockHz / 115200;
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

}  // namespace sonoglide::hal::mps2
