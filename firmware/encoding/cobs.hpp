/// Consistent overhead byte stuffing: a record without a zero byte, so that zero can end it.
/// Source: Cheshire and Baker, IEEE/ACM Transactions on Networking 7 (1999) 159-172.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::encoding {

inline constexpr std::uint8_t cobs_delimiter = 0;

/// Bytes that a record of `size` bytes takes at most, its delimiter not counted.
constexpr std::size_t cobs_size(std::size_t size) {
  return size + size / 254 + 1;
}

/// Writes the stuffed record, without a delimiter.
/// @param stuffed  room for cobs_size(size) bytes; must not overlap the record.
/// @return bytes written.
constexpr std::size_t cobs_encode(const std::uint8_t* bytes, std::size_t size,
                                  std::uint8_t* stuffed) {
  std::size_t code_at = 0;
  std::size_t end = 1;
  std::uint8_t code = 1;
  for (std::size_t i = 0; i < size; ++i) {
    if (bytes[i] != 0) {
      stuffed[end++] = bytes[i];
      ++code;
    }
    const bool full = code == 0xFF;
    if (bytes[i] == 0 || (full && i + 1 < size)) {
      stuffed[code_at] = code;
      code_at = end++;
      code = 1;
    }
  }
  stuffed[code_at] = code;
  return end;
}

/// Takes a stuffed record apart, one byte at a time and without a buffer.
class CobsDecoder {
 public:
  enum class Event : std::uint8_t {
    nothing,  ///< the byte was a code
    byte,     ///< one byte of the record, in `byte`
    end,      ///< the record is whole
    cut,      ///< the record ended in the middle of a block
    idle,     ///< a delimiter that no record stood before
  };

  Event take(std::uint8_t received, std::uint8_t& byte) {
    if (received == cobs_delimiter) {
      return finish();
    }
    if (left_ > 0) {
      --left_;
      byte = received;
      return Event::byte;
    }
    const bool zero = begun_ && zero_follows_;
    begun_ = true;
    left_ = static_cast<std::uint8_t>(received - 1);
    zero_follows_ = received != 0xFF;
    byte = 0;
    return zero ? Event::byte : Event::nothing;
  }

 private:
  Event finish() {
    const Event event = !begun_ ? Event::idle : left_ > 0 ? Event::cut : Event::end;
    *this = {};
    return event;
  }

  std::uint8_t left_ = 0;  ///< bytes of the block still to come
  bool zero_follows_ = false;
  bool begun_ = false;
};

}  // namespace sonoglide::encoding
