// Source: Arm, PrimeCell UART (PL011), Technical Reference Manual.
#include <cstddef>
#include <cstdint>

#include "hal/pico/board.hpp"
#include "hal/pico/pins.hpp"
#include "hal/pico/resets.hpp"

namespace sonoglide::hal::pico {
namespace {

struct UartRegisters {
  volatile std::uint32_t data;
  std::uint32_t reserved_0[5];
  volatile std::uint32_t flags;
  std::uint32_t reserved_1[2];
  volatile std::uint32_t divider;
  volatile std::uint32_t divider_fraction;  // 64ths
  volatile std::uint32_t format;            // a write takes the dividers over
  volatile std::uint32_t control;
};
static_assert(offsetof(UartRegisters, flags) == 0x18);
static_assert(offsetof(UartRegisters, divider) == 0x24);
static_assert(offsetof(UartRegisters, control) == 0x30);

extern "C" UartRegisters uart0;  // address from memory.ld

constexpr std::uint32_t receive_empty = 1U << 4;
constexpr std::uint32_t transmit_full = 1U << 5;
constexpr std::uint32_t of_8_bits = 3U << 5;
constexpr std::uint32_t with_queues = 1U << 4;
constexpr std::uint32_t enabled_both_ways = 1U << 0 | 1U << 8 | 1U << 9;

constexpr std::uint32_t divider_64ths = (system_hz * 4 + Uart::baud / 2) / Uart::baud;

}  // namespace

Uart::Uart() {
  release(reset_of_pins | reset_of_uart0);
  uart0.divider = divider_64ths / 64;
  uart0.divider_fraction = divider_64ths % 64;
  uart0.format = of_8_bits | with_queues;
  uart0.control = enabled_both_ways;
  drive_pin(0, PinFunction::uart);
  receive_on_pin(1, PinFunction::uart);
}

bool Uart::receive(std::uint8_t& byte) {
  if ((uart0.flags & receive_empty) != 0) {
    return false;
  }
  byte = static_cast<std::uint8_t>(uart0.data);
  return true;
}

bool Uart::send(std::uint8_t byte) {
  if ((uart0.flags & transmit_full) != 0) {
    return false;
  }
  uart0.data = byte;
  return true;
}

}  // namespace sonoglide::hal::pico
