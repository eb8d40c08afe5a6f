/// A checksum that tells content from what has become of it by accident.
#pragma once

#include <cstdint>
#include <string_view>

namespace sonoglide::text {

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

}  // namespace sonoglide::text
