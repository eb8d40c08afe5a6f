#include "hal/microbit/board.hpp"

#include <cstddef>

// Source: Nordic, nRF51 Series Reference Manual, clock, GPIO and UART; pins of the first micro:bit.
namespace sonoglide::hal::microbit {
namespace {

struct ClockRegisters {
  volatile std::uint32_t start_crystal;
  std::uint32_t reserved[63];
  volatile std::uint32_t crystal_started;
};
static_assert(offsetof(ClockRegisters, crystal_started) == 0x100);

struct PortRegisters {
  std::uint32_t reserved_0[322];
  volatile std::uint32_t set_output;
  std::uint32_t reserved_1[3];
  volatile std::uint32_t set_direction;
  std::uint32_t reserved_2[121];
  volatile std::uint32_t pin_configuration[32];
};
static_assert(offsetof(PortRegisters, set_output) == 0x508);
static_assert(offsetof(PortRegisters, set_direction) == 0x518);
static_assert(offsetof(PortRegisters, pin_configuration) == 0x700);

struct UartRegisters {
  volatile std::uint32_t start_receiver;
  std::uint32_t reserved_0;
  volatile std::uint32_t start_transmitter;
  std::uint32_t reserved_1[63];
  volatile std::uint32_t received;
  std::uint32_t reserved_2[4];
  volatile std::uint32_t sent;
  std::uint32_t reserved_3[248];
  volatile std::uint32_t enable;
  std::uint32_t reserved_4[2];
  volatile std::uint32_t output_pin;
  std::uint32_t reserved_5;
  volatile std::uint32_t input_pin;
  volatile std::uint32_t received_byte;
  volatile std::uint32_t sent_byte;
  std::uint32_t reserved_6;
  volatile std::uint32_t baud_rate;
};
static_assert(offsetof(UartRegisters, received) == 0x108);
static_assert(offsetof(UartRegisters, sent) == 0x11c);
static_assert(offsetof(UartRegisters, enable) == 0x500);
static_assert(offsetof(UartRegisters, output_pin) == 0x50c);
static_assert(offsetof(UartRegisters, received_byte) == 0x518);
static_assert(offsetof(UartRegisters, baud_rate) == 0x524);

// Addresses from memory.ld.
extern "C" {
extern ClockRegisters clock_control;
extern PortRegisters port0;
extern UartRegisters uart0;
}

constexpr std::uint32_t output_pin = 24;
constexpr std::uint32_t input_pin = 25;
constexpr std::uint32_t enabled = 4;
constexpr std::uint32_t baud_115200 = 0x01d7e000;

}  // namespace

Uart::Uart() {
  // The internal oscillator is not close enough to the baud rate.
  clock_control.start_crystal = 1;
  while (clock_control.crystal_started == 0) {
  }
  port0.set_output = 1U << output_pin;  // an idle line is high
  port0.set_direction = 1U << output_pin;
  port0.pin_configuration[input_pin] = 0;  // input, buffer connected
  uart0.output_pin = output_pin;
  uart0.input_pin = input_pin;
  uart0.baud_rate = baud_115200;
  uart0.enable = enabled;
  uart0.start_receiver = 1;
  uart0.start_transmitter = 1;
}

bool Uart::receive(std::uint8_t& byte) {
  if (uart0.received == 0) {
    return false;
  }
  uart0.received = 0;  // before the byte is read: the next one may be there at once
  byte = static_cast<std::uint8_t>(uart0.received_byte);
  return true;
}

bool Uart::send(std::uint8_t byte) {
  if (sending_ && uart0.sent == 0) {
    return false;
  }
  uart0.sent = 0;
  uart0.sent_byte = byte;
  sending_ = true;
  return true;
}

}  // namespace sonoglide::hal::microbit
