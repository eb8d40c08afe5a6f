/// A name for content.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "host_sim/text/checksum.hpp"

namespace sonoglide::emulated {

/// A checksum over texts, each with its length, so that "ab", "c" is not "a", "bc".
class ContentHash {
 public:
  void add(std::string_view text) {
    std::array<char, 8> length{};
    std::uint64_t left = text.size();
    for (char& byte : length) {
      byte = static_cast<char>(left & 0xffU);
      left >>= 8U;
    }
    sum_.add({length.data(), length.size()});
    sum_.add(text);
  }

  std::uint64_t value() const { return sum_.value(); }

 private:
  text::Checksum sum_;
};

}  // namespace sonoglide::emulated
