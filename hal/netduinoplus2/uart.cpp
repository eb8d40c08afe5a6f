#include "hal/netduinoplus2/board.hpp"

#include <cstddef>

// Source: ST, RM0090, RCC of the STM32F405, GPIO and USART; pins from the alternate function table
// of the datasheet.
namespace sonoglide::hal::netduinoplus2 {
namespace {

struct ClockRegisters {
  std::uint32_t reserved_0[12];
  volatile std::uint32_t ahb1_enable;
  std::uint32_t reserved_1[4];
  volatile std::uint32_t apb2_enable;
};
static_assert(offsetof(ClockRegisters, ahb1_enable) == 0x30);
static_assert(offsetof(ClockRegisters, apb2_enable) == 0x44);

struct PortRegisters {
  volatile std::uint32_t mode;
  std::uint32_t reserved[8];
  volatile std::uint32_t alternate_function_high;
};
static_assert(offsetof(PortRegisters, alternate_function_high) == 0x24);

struct UsartRegisters {
  volatile std::uint32_t status;
  volatile std::uint32_t data;
  volatile std::uint32_t baud_divider;
  volatile std::uint32_t control_1;
};

// Addresses from memory.ld.
extern "C" {
extern ClockRegisters clock_control;
extern PortRegisters port_a;
extern UsartRegisters usart1;
}

constexpr std::uint32_t port_a_clock = 1U << 0;
constexpr std::uint32_t usart1_clock = 1U << 4;
constexpr std::uint32_t receive_full = 1U << 5;
constexpr std::uint32_t transmit_empty = 1U << 7;
constexpr std::uint32_t receive_enabled = 1U << 2;
constexpr std::uint32_t transmit_enabled = 1U << 3;
constexpr std::uint32_t usart_enabled = 1U << 13;
constexpr std::uint32_t clock_hz = 16000000;  // the internal oscillator, on since reset

}  // namespace

Uart::Uart() {
  clock_control.ahb1_enable = clock_control.ahb1_enable | port_a_clock;
  clock_control.apb2_enable = clock_control.apb2_enable | usart1_clock;
  // Pins 9 and 10: alternate function 7.
  port_a.alternate_function_high = (port_a.alternate_function_high & ~0xff0U) | 0x770U;
  port_a.mode = (port_a.mode & ~(0xfU << 18)) | (0xaU << 18);
  usart1.baud_divider = (clock_hz + baud / 2) / baud;
  usart1.control_1 = usart_enabled | transmit_enabled | receive_enabled;
}

bool Uart::receive(std::uint8_t& byte) {
  const bool there = (usart1.status & receive_full) != 0;
  if (there) {
    byte = static_cast<std::uint8_t>(usart1.data);
  }
  return there;
}

bool Uart::send(std::uint8_t byte) {
  const bool room = (usart1.status & transmit_empty) != 0;
  if (room) {
    usart1.data = byte;
  }
  return room;
}

}  // namespace sonoglide::hal::netduinoplus2
