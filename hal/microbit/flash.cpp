#include "hal/microbit/board.hpp"

// Source: Nordic, nRF51 Series Reference Manual, NVMC; times from the nRF51822 specification.
namespace sonoglide::hal::microbit {
namespace {

struct ControllerRegisters {
  std::uint32_t reserved_0[256];
  volatile std::uint32_t ready;
  std::uint32_t reserved_1[64];
  volatile std::uint32_t configuration;
  volatile std::uint32_t erase_page;  // its address
};
static_assert(offsetof(ControllerRegisters, ready) == 0x400);
static_assert(offsetof(ControllerRegisters, configuration) == 0x504);

// Addresses from memory.ld.
extern "C" {
extern ControllerRegisters flash_control;
extern volatile std::uint32_t parameter_pages[2][Flash::page_words];
extern volatile std::uint32_t history_pages[2][Flash::page_words];
}

volatile std::uint32_t* words_of(std::size_t page) {
  return page < 2 ? parameter_pages[page] : history_pages[page - 2];
}

enum Configuration : std::uint32_t { read_only = 0, write_enabled = 1, erase_enabled = 2 };

void wait() {
  while (flash_control.ready == 0) {
  }
}

}  // namespace

std::uint32_t Flash::read(std::size_t page, std::size_t word) const {
  return words_of(page)[word];
}

void Flash::erase(std::size_t page) {
  flash_control.configuration = erase_enabled;
  wait();
  flash_control.erase_page =
      static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(words_of(page)));
  wait();
  flash_control.configuration = read_only;
}

void Flash::program(std::size_t page, std::size_t word, std::uint32_t value) {
  flash_control.configuration = write_enabled;
  wait();
  words_of(page)[word] = value;
  wait();
  flash_control.configuration = read_only;
}

bool Flash::busy() const {
  return flash_control.ready == 0;
}

}  // namespace sonoglide::hal::microbit
