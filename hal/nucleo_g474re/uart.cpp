// Source: ST, RM0440, USART, DMA and DMAMUX (table of requests); pins from the alternate function table of
// the datasheet.
#include <cstddef>
#include <cstdint>

#include "hal/nucleo_g474re/board.hpp"
#include "hal/nucleo_g474re/transfers.hpp"

namespace sonoglide::hal::nucleo_g474re {
namespace {

struct UsartRegisters {
  volatile std::uint32_t control_1;
  volatile std::uint32_t control_2;
  volatile std::uint32_t control_3;
  volatile std::uint32_t divider;
  std::uint32_t reserved[3];
  volatile std::uint32_t status;
  volatile std::uint32_t clear;
  volatile std::uint32_t received;
  volatile std::uint32_t sent;
};
static_assert(offsetof(UsartRegisters, status) == 0x1c);
static_assert(offsetof(UsartRegisters, sent) == 0x28);

extern "C" UsartRegisters usart2;  // address from memory.ld

constexpr std::uint32_t usart2_clock = 1U << 17;
constexpr std::uint32_t with_queues = 1U << 29;
constexpr std::uint32_t enabled_both_ways = 1U << 0 | 1U << 2 | 1U << 3;
constexpr std::uint32_t receives_by_transfers = 1U << 6;
constexpr std::uint32_t overruns_ignored = 1U << 12;
constexpr std::uint32_t room_to_send = 1U << 7;
constexpr std::uint32_t baud = 115200;

constexpr std::size_t channel = 2;
constexpr std::uint32_t request_of_usart2 = 26;
constexpr std::size_t ring_bytes = 256;
volatile std::uint8_t ring[ring_bytes];

}  // namespace

Uart::Uart() {
  enable_clocks();
  clock_control.apb1_enable = clock_control.apb1_enable | usart2_clock;
  start_transfer(channel, request_of_usart2, &usart2.received, ring, ring_bytes, of_8_bits);
  usart2.divider = (system_hz + baud / 2) / baud;
  usart2.control_3 = receives_by_transfers | overruns_ignored;
  usart2.control_1 = with_queues;
  usart2.control_1 = with_queues | enabled_both_ways;
  use_pin(port_a, 2, 7, pulled_up);
  use_pin(port_a, 3, 7, pulled_up);
}

bool Uart::receive(std::uint8_t& byte) {
  if (next_ == ring_bytes - transfers[channel].count) {
    return false;
  }
  byte = ring[next_];
  next_ = (next_ + 1) % ring_bytes;
  return true;
}

bool Uart::send(std::uint8_t byte) {
  if ((usart2.status & room_to_send) == 0) {
    return false;
  }
  usart2.sent = byte;
  return true;
}

}  // namespace sonoglide::hal::nucleo_g474re
