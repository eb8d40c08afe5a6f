/// A line of text in a fixed space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/encoding/decimal.hpp"

namespace sonoglide::encoding {

/// Some characters of a text that lives elsewhere.
struct Characters {
  const char* begin = nullptr;
  std::size_t size = 0;

  bool are(const char* word) const {
    for (std::size_t i = 0; i < size; ++i) {
      if (word[i] == '\0' || word[i] != begin[i]) {
        return false;
      }
    }
    return word[size] == '\0';
  }
};

/// Text of up to `Capacity` characters; what is added beyond is lost.
template <std::size_t Capacity>
class TextLine {
 public:
  void clear() { size_ = 0; }

  void add(char character) {
    if (size_ < Capacity) {
      text_[size_++] = character;
    }
  }
  [[gnu::noinline]] void add(const char* text) {
    for (; *text != '\0'; ++text) {
      add(*text);
    }
  }
  void add(const Characters& text) {
    for (std::size_t i = 0; i < text.size; ++i) {
      add(text.begin[i]);
    }
  }
  /// value * 10^-places.
  [[gnu::noinline]] void add_number(std::uint32_t value, int places = 0) {
    char digits[most_decimal_characters] = {};
    const std::size_t size = write_decimal(value, places, digits);
    add(Characters{digits, size});
  }

  std::size_t size() const { return size_; }
  char operator[](std::size_t at) const { return text_[at]; }
  const char* data() const { return text_.data(); }

 private:
  std::array<char, Capacity> text_{};
  std::size_t size_ = 0;
};

}  // namespace sonoglide::encoding
