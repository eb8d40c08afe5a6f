// Source: ST, RM0440, embedded flash memory: page erase, standard programming.
#include <cstddef>
#include <cstdint>

#include "hal/nucleo_g474re/board.hpp"

namespace sonoglide::hal::nucleo_g474re {
namespace {

// Addresses from memory.ld.
extern "C" {
extern volatile std::uint32_t parameter_pages[2][Flash::page_words][2];
extern volatile std::uint32_t history_pages[2][Flash::page_words][2];
}

constexpr std::uint32_t first_key = 0x45670123;
constexpr std::uint32_t second_key = 0xcdef89ab;
constexpr std::uint32_t programming = 1U << 0;
constexpr std::uint32_t erasing = 1U << 1;
constexpr unsigned page_position = 3;
constexpr std::uint32_t first_page = 126;
constexpr std::uint32_t first_page_of_history = 124;
constexpr std::uint32_t in_second_bank = 1U << 11;
constexpr std::uint32_t start = 1U << 16;
constexpr std::uint32_t locked = 1U << 31;
constexpr std::uint32_t working = 1U << 16;
constexpr std::uint32_t every_error = 0xc3fb;  // a set bit clears it

volatile std::uint32_t* place_of(std::size_t page, std::size_t word) {
  return page < 2 ? parameter_pages[page][word] : history_pages[page - 2][word];
}

void unlock() {
  // A key that it does not ask for locks it until a reset.
  if ((flash_control.control & locked) != 0) {
    flash_control.key = first_key;
    flash_control.key = second_key;
  }
  flash_control.status = every_error;
}

}  // namespace

std::uint32_t Flash::read(std::size_t page, std::size_t word) const {
  return place_of(page, word)[0];
}

void Flash::erase(std::size_t page) {
  unlock();
  const std::uint32_t number = page < 2
                                   ? first_page + static_cast<std::uint32_t>(page)
                                   : first_page_of_history + static_cast<std::uint32_t>(page) - 2;
  const std::uint32_t order = erasing | in_second_bank | number << page_position;
  flash_control.control = order;
  flash_control.control = order | start;
}

// The flash takes 64 bits at a time.
void Flash::program(std::size_t page, std::size_t word, std::uint32_t value) {
  unlock();
  flash_control.control = programming;
  volatile std::uint32_t* const place = place_of(page, word);
  place[0] = value;
  place[1] = value;
}

bool Flash::busy() const {
  if ((flash_control.status & working) != 0) {
    return true;
  }
  flash_control.control = locked;
  return false;
}

}  // namespace sonoglide::hal::nucleo_g474re
