/// A checksum that tells a record from a torn one.
#pragma once

#include <cstdint>
#include <string_view>

namespace sonoglide::sweep {

/// 64-bit FNV-1a. Source: Fowler, Noll and Vo, draft-eastlake-fnv.
constexpr std::uint64_t checksum(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return hash;
}

}  // namespace sonoglide::sweep
