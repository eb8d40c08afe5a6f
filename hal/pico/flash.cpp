// Source: Raspberry Pi, RP2040 Datasheet, SSI; Winbond, W25Q16JV, instructions, which all such chips have.
#include <cstddef>
#include <cstdint>

#include "hal/pico/board.hpp"

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
extern std::uint8_t parameter_sectors[];
}

constexpr std::uint32_t frames_of_8_bits = 7U << 16;
constexpr std::uint32_t clocks_of_system = 4;
constexpr std::uint32_t room_to_send = 1U << 1;
constexpr std::uint32_t received = 1U << 3;
constexpr std::uint32_t select_low = 2U << 8;
constexpr std::uint32_t select_high = 3U << 8;
constexpr std::size_t sector_bytes = 4096;

enum class Instruction : std::uint8_t {
  program_page = 0x02,
  read = 0x03,
  read_status = 0x05,
  enable_write = 0x06,
  erase_sector = 0x20,
};

/// An instruction, its chip selected while this lives. Interrupts may come in between: the select is held by
/// its pin, not by the queue of the link.
class Exchange {
 public:
  explicit Exchange(Instruction instruction) {
    flash_pins.select_control = select_low;
    send(static_cast<std::uint8_t>(instruction));
  }
  Exchange(Instruction instruction, std::uint32_t address) : Exchange(instruction) {
    send(static_cast<std::uint8_t>(address >> 16));
    send(static_cast<std::uint8_t>(address >> 8));
    send(static_cast<std::uint8_t>(address));
  }
  ~Exchange() { flash_pins.select_control = select_high; }
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  /// @return what came back meanwhile
  std::uint8_t send(std::uint8_t byte) {
    while ((flash_link.status & room_to_send) == 0) {
    }
    flash_link.data = byte;
    while ((flash_link.status & received) == 0) {
    }
    return static_cast<std::uint8_t>(flash_link.data);
  }
};

std::uint32_t address(std::size_t page, std::size_t word) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(parameter_sectors) +
                                    page * sector_bytes + 4 * word);
}

void enable_write() {
  const Exchange exchange(Instruction::enable_write);
}

}  // namespace

Flash::Flash() {
  flash_pins.select_control = select_high;
  flash_link.enable = 0;
  flash_link.control = frames_of_8_bits;
  flash_link.divider = clocks_of_system;
  flash_link.selected = 1;
  flash_link.enable = 1;
}

std::uint32_t Flash::read(std::size_t page, std::size_t word) const {
  Exchange exchange(Instruction::read, address(page, word));
  std::uint32_t value = 0;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    value |= std::uint32_t{exchange.send(0)} << shift;
  }
  return value;
}

void Flash::erase(std::size_t page) {
  enable_write();
  const Exchange exchange(Instruction::erase_sector, address(page, 0));
}

void Flash::program(std::size_t page, std::size_t word, std::uint32_t value) {
  enable_write();
  Exchange exchange(Instruction::program_page, address(page, word));
  for (unsigned shift = 0; shift < 32; shift += 8) {
    exchange.send(static_cast<std::uint8_t>(value >> shift));
  }
}

bool Flash::busy() const {
  Exchange exchange(Instruction::read_status);
  return (exchange.send(0) & 1) != 0;
}

}  // namespace sonoglide::hal::pico
