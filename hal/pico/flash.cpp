// Source: Winbond, W25Q16JV, instructions, which all such chips have.
#include <cstddef>
#include <cstdint>

#include "hal/pico/board.hpp"
#include "hal/pico/flash_link.hpp"

namespace sonoglide::hal::pico {
namespace {

// Addresses from memory.ld.
extern "C" {
extern std::uint8_t parameter_sectors[];
extern std::uint8_t history_sectors[];
}

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
    select_flash(true);
    send(static_cast<std::uint8_t>(instruction));
  }
  Exchange(Instruction instruction, std::uint32_t address) : Exchange(instruction) {
    send(static_cast<std::uint8_t>(address >> 16));
    send(static_cast<std::uint8_t>(address >> 8));
    send(static_cast<std::uint8_t>(address));
  }
  ~Exchange() { select_flash(false); }
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  /// @return what came back meanwhile
  std::uint8_t send(std::uint8_t byte) { return exchange_with_flash(byte); }
};

std::uint32_t address(std::size_t page, std::size_t word) {
  const auto* const sector = page < 2 ? parameter_sectors + page * sector_bytes
                                      : history_sectors + (page - 2) * sector_bytes;
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(sector) + 4 * word);
}

void enable_write() {
  const Exchange exchange(Instruction::enable_write);
}

}  // namespace

Flash::Flash() {
  start_flash_link();
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
