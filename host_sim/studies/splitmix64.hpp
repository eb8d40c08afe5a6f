/// The generator splitmix64 (Steele, Lea and Flood 2014, Fast splittable pseudorandom number
/// generators): its state rises by splitmix64_step, and mixed() of it is the next number.
#pragma once

#include <cstdint>

namespace sonoglide::studies {

inline constexpr std::uint64_t splitmix64_step =
    0x9e3779b97f4a7c15U;  ///< 2^64 over the golden ratio

/// One to one; every bit of the input reaches every bit of the result.
constexpr std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

}  // namespace sonoglide::studies
