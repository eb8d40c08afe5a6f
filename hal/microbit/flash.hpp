/// Flash of the nRF51, through its non-volatile memory controller.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::microbit {

/// The last two pages, which the linker script keeps free of code. The processor stands still while
/// a page is erased (22 ms) or a word is programmed (46 us), because its code is in the same flash.
class Flash {
 public:
  static constexpr std::size_t page_words = 256;

  std::uint32_t read(std::size_t page, std::size_t word) const;
  void erase(std::size_t page);
  void program(std::size_t page, std::size_t word, std::uint32_t value);
  bool busy() const;
};

}  // namespace sonoglide::hal::microbit
