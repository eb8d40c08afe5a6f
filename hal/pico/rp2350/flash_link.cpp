// Source: Raspberry Pi, RP2350 Datasheet, QMI, direct mode.
#include "hal/pico/flash_link.hpp"

#include <cstdint>

namespace sonoglide::hal::pico {
namespace {

struct LinkRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t send;
  volatile std::uint32_t receive;
};

extern "C" LinkRegisters flash_link;  // address from memory.ld

constexpr std::uint32_t enabled = 1U << 0;
constexpr std::uint32_t busy = 1U << 1;
constexpr std::uint32_t chip_selected = 1U << 2;
constexpr std::uint32_t full = 1U << 10;
constexpr std::uint32_t empty = 1U << 16;
constexpr std::uint32_t clocks_of_system = 6U << 22;  // 25 MHz
constexpr std::uint32_t line_driven = 1U << 19;

}  // namespace

void select_flash(bool selected) {
  flash_link.control = clocks_of_system | (selected ? chip_selected : 0U) | enabled;
}

void start_flash_link() {
  select_flash(false);
  while ((flash_link.control & busy) != 0) {
  }
}

std::uint8_t exchange_with_flash(std::uint8_t byte) {
  while ((flash_link.control & full) != 0) {
  }
  flash_link.send = line_driven | byte;
  while ((flash_link.control & empty) != 0) {
  }
  return static_cast<std::uint8_t>(flash_link.receive);
}

}  // namespace sonoglide::hal::pico
