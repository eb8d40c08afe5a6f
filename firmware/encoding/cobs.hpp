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

/// Stuffs a record one byte at a time.
class CobsEncoder {
 public:
  /// @param stuffed  room for cobs_size() of the whole record.
  explicit constexpr CobsEncoder(std::uint8_t* stuffed) : stuffed_(stuffed) {}

  constexpr void add(std::uint8_t byte) {
    if (code_ == 0xFF) {  // a full block; only now is it known not to be the last
      begin_block();
    }
    if (byte == 0) {
      begin_block();
    } else {
      stuffed_[end_++] = byte;
      ++code_;
    }
  }

  /// Ends the record, without a delimiter.
  /// @return bytes written.
  constexpr std::size_t finish() {
    stuffed_[code_at_] = code_;
    return end_;
  }

 private:
  constexpr void begin_block() {
    stuffed_[code_at_] = code_;
    code_at_ = end_++;
    code_ = 1;
  }

  std::uint8_t* stuffed_;
  std::size_t code_at_ = 0;
  std::size_t end_ = 1;
  std::uint8_t code_ = 1;
};

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

  /// A record has begun that has not ended.
  bool begun() const { return begun_; }

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
