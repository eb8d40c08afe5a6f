/// Stands in for flash on a board that has none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::timed {

/// Two pages in RAM, erased at reset, so that saved parameters are lost with it. Never busy.
class VolatilePages {
 public:
  static constexpr std::size_t page_words = 64;

  VolatilePages() {
    erase(0);
    erase(1);
  }

  std::uint32_t read(std::size_t page, std::size_t word) const { return pages_[page][word]; }
  void erase(std::size_t page) { pages_[page].fill(0xffffffffU); }
  void program(std::size_t page, std::size_t word, std::uint32_t value) {
    pages_[page][word] &= value;
  }
  bool busy() const { return false; }

 private:
  std::array<std::array<std::uint32_t, page_words>, 2> pages_{};
};

}  // namespace sonoglide::hal::timed
