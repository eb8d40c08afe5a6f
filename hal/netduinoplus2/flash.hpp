/// Flash of the STM32F405.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::netduinoplus2 {

/// The first 256 bytes of the last two sectors of 128 KiB, which the linker script keeps free of
/// code. An erase takes 1 to 2 s, at most 4 s. The processor stands still meanwhile, because its
/// code is in the same flash. So the watchdog, which must have been started, is made to wait. The
/// controller of the flash is locked except during an operation. The data cache must be off, as it
/// is after a reset.
class Flash {
 public:
  static constexpr std::size_t page_words = 64;

  std::uint32_t read(std::size_t page, std::size_t word) const;
  void erase(std::size_t page);
  void program(std::size_t page, std::size_t word, std::uint32_t value);
  bool busy() const;
};

}  // namespace sonoglide::hal::netduinoplus2
