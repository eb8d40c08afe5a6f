/// One number for a whole sequence of drive commands.
#pragma once

#include <cstdint>

#include "hal/board.hpp"

namespace sonoglide::loop {

/// 64-bit FNV-1a over every drive command: amplitude (four bytes, lowest first), state, limit,
/// fault. Source: Fowler, Noll and Vo, draft-eastlake-fnv.
class TraceHash {
 public:
  void add(const hal::Drive& drive) {
    const auto amplitude = static_cast<std::uint32_t>(drive.amplitude);
    for (unsigned shift = 0; shift < 32; shift += 8) {
      add_byte(static_cast<std::uint8_t>(amplitude >> shift));
    }
    add_byte(drive.state);
    add_byte(drive.limit);
    add_byte(drive.fault);
  }

  std::uint64_t value() const { return hash_; }

 private:
  void add_byte(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001b3U; }

  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace sonoglide::loop
