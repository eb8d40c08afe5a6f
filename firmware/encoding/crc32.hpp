/// The CRC-32 of IEEE 802.3.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sonoglide::encoding {

namespace detail {

/// At compile time.
constexpr std::array<std::uint32_t, 16> crc32_of_nibbles() {
  std::array<std::uint32_t, 16> table{};
  for (std::uint32_t nibble = 0; nibble < 16; ++nibble) {
    std::uint32_t rest = nibble;
    for (int bit = 0; bit < 4; ++bit) {
      rest = (rest & 1U) != 0 ? rest >> 1 ^ 0xEDB88320U : rest >> 1;
    }
    table[nibble] = rest;
  }
  return table;
}

}  // namespace detail

/// Polynomial 0x04C11DB7, reflected (0xEDB88320); begun with and closed by ones. Check value, of
/// "123456789": 0xCBF43926. Finds any three wrong bits in a record of up to 91606 bits, and any
/// burst of up to 32.
///
/// Half a byte at a time: a table of 64 bytes and two look-ups for each byte, where bit by bit
/// takes eight rounds and a whole-byte table 1 KB.
class Crc32 {
 public:
  constexpr void add(std::uint8_t byte) {
    rest_ = rest_ >> 4 ^ nibbles[(rest_ ^ byte) & 15U];
    rest_ = rest_ >> 4 ^ nibbles[(rest_ ^ (byte >> 4)) & 15U];
  }

  /// The four bytes of a word, the lowest first.
  constexpr void add_word(std::uint32_t word) {
    for (int i = 0; i < 4; ++i, word >>= 8) {
      add(static_cast<std::uint8_t>(word));
    }
  }

  constexpr std::uint32_t value() const { return ~rest_; }

  /// Of a record that its own CRC-32 follows, the lowest byte first.
  constexpr bool closed() const { return rest_ == 0xDEBB20E3U; }

 private:
  static constexpr std::array<std::uint32_t, 16> nibbles = detail::crc32_of_nibbles();

  std::uint32_t rest_ = 0xFFFFFFFFU;
};

/// CRC-32 of `size` bytes.
constexpr std::uint32_t crc32(const std::uint8_t* bytes, std::size_t size) {
  Crc32 crc;
  for (std::size_t i = 0; i < size; ++i) {
    crc.add(bytes[i]);
  }
  return crc.value();
}

}  // namespace sonoglide::encoding
