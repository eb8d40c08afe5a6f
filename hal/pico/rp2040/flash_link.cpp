// Source: Raspberry Pi, RP2040 Datasheet, SSI.
#include "hal/pico/flash_link.hpp"

#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::pico {
namespace {

struct LinkRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t frames;
  volatile std::uint32_t enable;
  std::uint32_t reserved_0;
  volatile std::uint32_t selected;
  volatile std::uint32_t divider;
  std::uint32_t reserved_1[4];
  volatile std::uint32_t status;
  std::uint32_t reserved_2[13];
  volatile std::uint32_t data;
};
static_assert(offsetof(LinkRegisters, status) == 0x28);
static_assert(offsetof(LinkRegisters, data) == 0x60);

struct FlashPinRegisters {
  std::uint32_t clock[2];
  volatile std::uint32_t select_status;
  volatile std::uint32_t select_control;
};

// Addresses from memory.ld.
extern "C" {
extern LinkRegisters flash_link;
extern FlashPinRegisters flash_pins;
}

constexpr std::uint32_t frames_of_8_bits = 7U << 16;
constexpr std::uint32_t clocks_of_system = 4;
constexpr std::uint32_t room_to_send = 1U << 1;
constexpr std::uint32_t received = 1U << 3;
constexpr std::uint32_t select_low = 2U << 8;
constexpr std::uint32_t select_high = 3U << 8;

}  // namespace

// The select is held by its pin, not by the queue of the link: interrupts may come in between.
void select_flash(bool selected) {
  flash_pins.select_control = selected ? select_low : select_high;
}

void start_flash_link() {
  select_flash(false);
  flash_link.enable = 0;
  flash_link.control = frames_of_8_bits;
  flash_link.divider = clocks_of_system;
  flash_link.selected = 1;
  flash_link.enable = 1;
}

std::uint8_t exchange_with_flash(std::uint8_t byte) {
  while ((flash_link.status & room_to_send) == 0) {
  }
  flash_link.data = byte;
  while ((flash_link.status & received) == 0) {
  }
  return static_cast<std::uint8_t>(flash_link.data);
}

}  // namespace sonoglide::hal::pico
