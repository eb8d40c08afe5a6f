#include "hal/riscv_virt/board.hpp"

#include <cstddef>

// Source: Texas Instruments, PC16550D data sheet. The divisor latch shares its addresses
// with data and interrupts.
namespace sonoglide::hal::riscv_virt {
namespace {

struct UartRegisters {
  volatile std::uint8_t data;        // or divisor, low
  volatile std::uint8_t interrupts;  // or divisor, high
  volatile std::uint8_t fifo_control;
  volatile std::uint8_t line_control;
  volatile std::uint8_t modem_control;
  volatile std::uint8_t line_status;
};
static_assert(offsetof(UartRegisters, line_status) == 5);

extern "C" UartRegisters uart0;  // address from memory.ld

constexpr std::uint8_t eight_bits = 0x03;
constexpr std::uint8_t divisor_latch = 0x80;
constexpr std::uint8_t fifo_enabled = 0x01;
constexpr std::uint8_t received = 0x01;
constexpr std::uint8_t transmit_empty = 0x20;
constexpr std::uint8_t divisor = 3686400 / (16 * Uart::baud);  // of the clock in hertz

}  // namespace

Uart::Uart() {
  uart0.line_control = divisor_latch | eight_bits;
  uart0.data = divisor;
  uart0.interrupts = 0;
  uart0.line_control = eight_bits;
  uart0.fifo_control = fifo_enabled;
}

bool Uart::receive(std::uint8_t& byte) {
  const bool there = (uart0.line_status & received) != 0;
  if (there) {
    byte = uart0.data;
  }
  return there;
}

bool Uart::send(std::uint8_t byte) {
  const bool room = (uart0.line_status & transmit_empty) != 0;
  if (room) {
    uart0.data = byte;
  }
  return room;
}

}  // namespace sonoglide::hal::riscv_virt
