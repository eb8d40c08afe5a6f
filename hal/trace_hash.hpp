/// One number for a whole sequence of samples or drives.
#pragma once

#include <cstdint>

#include "hal/board.hpp"

namespace sonoglide::hal {

/// 64-bit FNV-1a over every drive command (amplitude, commanded_ratio, state, limit, fault,
/// settling; of a resonant one the frequency after them, of a biased one the bias), or over every sample (friction_force,
/// sliding_velocity, force_at_rail, fresh); a code is four bytes, lowest first, a flag is a byte, 1
/// or 0. Source: Fowler, Noll and Vo, draft-eastlake-fnv.
class TraceHash {
 public:
  void add(const Drive& drive) {
    add_code(drive.amplitude);
    add_code(drive.commanded_ratio);
    add_byte(drive.state);
    add_byte(drive.limit);
    add_byte(drive.fault);
    add_byte(drive.settling);
  }

  void add(const ResonantDrive& drive) {
    add(static_cast<const Drive&>(drive));
    add_code(drive.frequency);
  }

  void add(const BiasedDrive& drive) {
    add(static_cast<const Drive&>(drive));
    add_code(drive.bias);
  }

  void add(const Sample& sample) {
    add_code(sample.friction_force);
    add_code(sample.sliding_velocity);
    add_byte(sample.force_at_rail ? 1 : 0);
    add_byte(sample.fresh ? 1 : 0);
  }

  std::uint64_t value() const { return hash_; }

 private:
  void add_code(std::int32_t code) {
    const auto bits = static_cast<std::uint32_t>(code);
    for (unsigned shift = 0; shift < 32; shift += 8) {
      add_byte(static_cast<std::uint8_t>(bits >> shift));
    }
  }
  void add_byte(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001b3U; }

  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace sonoglide::hal
