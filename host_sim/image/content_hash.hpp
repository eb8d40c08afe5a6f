/// A name for content.
#pragma once

#include <cstdint>
#include <string_view>

namespace sonoglide::image {

/// 64-bit FNV-1a over texts, each with its length, so that "ab", "c" is not "a", "bc".
/// Source: Fowler, Noll and Vo, draft-eastlake-fnv.
class ContentHash {
 public:
  void add(std::string_view text) {
    add_word(text.size());
    for (const char each : text) {
      add_byte(static_cast<std::uint8_t>(each));
    }
  }

  std::uint64_t value() const { return hash_; }

 private:
  void add_word(std::uint64_t word) {
    for (unsigned shift = 0; shift < 64; shift += 8) {
      add_byte(static_cast<std::uint8_t>(word >> shift));
    }
  }
  void add_byte(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001b3U; }

  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace sonoglide::image
