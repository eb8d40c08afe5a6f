/// How a message travels on a byte link.
///
/// | offset | bytes  | field                                                       |
/// |--------|--------|-------------------------------------------------------------|
/// | 0      | 1      | version of this table                                       |
/// | 1      | 1      | kind of message                                             |
/// | 2      | 2      | sequence number: an answer bears that of its request        |
/// | 4      | 0 … 32 | payload, as the kind says                                   |
/// | end    | 4      | CRC-32 (IEEE 802.3) of all before it                        |
///
/// Numbers are little-endian. On the wire the frame is stuffed (COBS) and stands between two zero
/// bytes. The first one separates it from noise that came before.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/encoding/cobs.hpp"
#include "firmware/encoding/crc32.hpp"
#include "firmware/encoding/little_endian.hpp"

namespace sonoglide::link {

inline constexpr std::uint8_t version = 2;
inline constexpr std::size_t most_payload_bytes = 32;
inline constexpr std::size_t header_bytes = 4;
inline constexpr std::size_t checksum_bytes = 4;
inline constexpr std::size_t most_frame_bytes = header_bytes + most_payload_bytes + checksum_bytes;
inline constexpr std::size_t most_wire_bytes = 1 + encoding::cobs_size(most_frame_bytes) + 1;

/// A frame without its stuffing and its checksum.
struct Frame {
  std::uint8_t kind = 0;
  std::uint16_t sequence = 0;
  std::uint8_t payload_bytes = 0;
  std::array<std::uint8_t, most_payload_bytes> payload{};
};

/// The bytes of a frame as they go over the wire.
struct WireFrame {
  std::size_t size = 0;
  std::array<std::uint8_t, most_wire_bytes> bytes{};
};

/// Puts a frame on the wire, one byte at a time.
class FrameEncoder {
 public:
  FrameEncoder() = default;
  // Its stuffing points into its own wire.
  FrameEncoder(const FrameEncoder&) = delete;
  FrameEncoder& operator=(const FrameEncoder&) = delete;

  /// @param frame  its payload_bytes at most most_payload_bytes.
  void begin(const Frame& frame) {
    frame_ = frame;
    checksum_ = {};
    stuffing_ = encoding::CobsEncoder(&wire_.bytes[1]);
    wire_.bytes[0] = encoding::cobs_delimiter;
    wire_.size = 0;
    at_ = 0;
    busy_ = true;
  }

  /// A frame was begun that is not yet whole.
  bool busy() const { return busy_; }

  /// Encodes the next byte.
  void proceed() {
    const std::size_t checksum_at = header_bytes + frame_.payload_bytes;
    if (at_ < checksum_at) {
      const std::uint8_t next = byte(at_);
      checksum_.add(next);
      stuffing_.add(next);
    } else {
      stuffing_.add(static_cast<std::uint8_t>(checksum_.value() >> (8 * (at_ - checksum_at))));
    }
    if (++at_ == checksum_at + checksum_bytes) {
      wire_.size = 1 + stuffing_.finish();
      wire_.bytes[wire_.size++] = encoding::cobs_delimiter;
      busy_ = false;
    }
  }

  /// The frame as it goes out; of no size while busy.
  const WireFrame& wire() const { return wire_; }

 private:
  std::uint8_t byte(std::size_t at) const {
    switch (at) {
      case 0:
        return version;
      case 1:
        return frame_.kind;
      case 2:
        return static_cast<std::uint8_t>(frame_.sequence);
      case 3:
        return static_cast<std::uint8_t>(frame_.sequence >> 8);
      default:
        return frame_.payload[at - header_bytes];
    }
  }

  Frame frame_;
  WireFrame wire_;
  encoding::Crc32 checksum_;
  encoding::CobsEncoder stuffing_{wire_.bytes.data()};
  std::size_t at_ = 0;
  bool busy_ = false;
};

/// A whole frame at once.
inline WireFrame encode(const Frame& frame) {
  FrameEncoder encoder;
  encoder.begin(frame);
  while (encoder.busy()) {
    encoder.proceed();
  }
  return encoder.wire();
}

/// Result of a received byte. All but `nothing` come with the zero byte that ends a frame; the next
/// byte begins a new one.
enum class Reception : std::uint8_t {
  nothing,
  frame,          ///< a whole one, in frame()
  truncated,      ///< too short for a frame, or cut in a block of the stuffing
  oversized,      ///< longer than any frame
  corrupted,      ///< its checksum is wrong
  wrong_version,  ///< whole, but of another version of the protocol
};

/// Finds frames in a stream of bytes. Work and memory are bounded for each byte, whatever comes.
class FrameDecoder {
 public:
  /// A frame has begun that has not ended.
  bool begun() const { return stuffing_.begun(); }

  Reception take(std::uint8_t received) {
    std::uint8_t byte = 0;
    switch (stuffing_.take(received, byte)) {
      case encoding::CobsDecoder::Event::byte:
        keep(byte);
        return Reception::nothing;
      case encoding::CobsDecoder::Event::end:
        return finish(true);
      case encoding::CobsDecoder::Event::cut:
        return finish(false);
      case encoding::CobsDecoder::Event::nothing:
      case encoding::CobsDecoder::Event::idle:
        break;
    }
    return Reception::nothing;
  }

  /// Valid until the next byte is taken.
  const Frame& frame() const { return frame_; }
  /// Of that frame: what tells two frames of one sequence number apart.
  std::uint32_t checksum() const { return frame_checksum_; }

 private:
  void keep(std::uint8_t byte) {
    if (size_ < bytes_.size()) {
      bytes_[size_] = byte;
      checksum_.add(byte);
    }
    size_ += size_ <= bytes_.size() ? 1U : 0U;
  }

  Reception finish(bool whole_blocks) {
    const std::size_t size = size_;
    const bool intact = checksum_.closed();
    size_ = 0;
    checksum_ = {};
    if (size > bytes_.size()) {
      return Reception::oversized;
    }
    if (!whole_blocks || size < header_bytes + checksum_bytes) {
      return Reception::truncated;
    }
    if (!intact) {
      return Reception::corrupted;
    }
    if (bytes_[0] != version) {
      return Reception::wrong_version;
    }
    read_frame(size - header_bytes - checksum_bytes);
    return Reception::frame;
  }

  void read_frame(std::size_t payload_bytes) {
    frame_.kind = bytes_[1];
    frame_.sequence = encoding::get_little_endian<std::uint16_t>(&bytes_[2]);
    frame_.payload_bytes = static_cast<std::uint8_t>(payload_bytes);
    for (std::size_t i = 0; i < payload_bytes; ++i) {
      frame_.payload[i] = bytes_[header_bytes + i];
    }
    frame_checksum_ =
        encoding::get_little_endian<std::uint32_t>(&bytes_[header_bytes + payload_bytes]);
  }

  encoding::CobsDecoder stuffing_;
  encoding::Crc32 checksum_;
  std::size_t size_ = 0;  ///< bytes_.size() + 1: too long
  std::array<std::uint8_t, most_frame_bytes> bytes_{};
  Frame frame_;
  std::uint32_t frame_checksum_ = 0;
};

}  // namespace sonoglide::link
