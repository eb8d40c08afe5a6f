/// A checksum that tells content from what has become of it by accident.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sonoglide::process {

/// 64-bit FNV-1a, piece by piece. Source: Fowler, Noll and Vo, draft-eastlake-fnv.
class Checksum {
 public:
  constexpr void add(std::string_view text) {
    for (const char each : text) {
      hash_ = (hash_ ^ static_cast<unsigned char>(each)) * 0x100000001b3U;
    }
  }
  constexpr std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

constexpr std::uint64_t checksum(std::string_view text) {
  Checksum whole;
  whole.add(text);
  return whole.value();
}

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
  Checksum sum_;
};

}  // namespace sonoglide::process
