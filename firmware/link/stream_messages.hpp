/// The messages of a stream: what a unit shows its host again and again, unasked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/link/payload.hpp"

namespace sonoglide::link {

/// What a stream may show, in the order of its values.
enum class Channel : std::uint8_t {
  friction_force,    ///< converter code
  sliding_velocity,  ///< converter code
  amplitude,         ///< code in force; full scale: the actuator's limit
  commanded_ratio,   ///< friction ratio, target and feedback together; 2^31 is a ratio of 2
  target,            ///< app::Parameter::target, millionths
  codes,             ///< bytes from the lowest on: state, limit, fault, settling; see Telemetry
};
inline constexpr std::size_t channel_count = 6;
inline constexpr std::uint32_t all_channels = (1U << channel_count) - 1;

/// Asks for a sample in each so many steps, until a hello, a reset or a stream of no channel.
struct Stream {
  static constexpr std::uint8_t kind = 0x0B;
  std::uint8_t channels;  ///< bit i: Channel i; 0 ends the stream
  std::uint16_t every;    ///< steps from a sample to the next, 1 ... 65535

  template <class Message, class Visitor>
  static constexpr void fields(Message& message, Visitor&& visit) {
    visit(message.channels);
    visit(message.every);
  }
};

/// Answers Stream.
struct Streaming : Stream {
  static constexpr std::uint8_t kind = Stream::kind | answer_bit;
};

/// A sample of a stream. The sequence number of its frame is that of the sample, from 0 on: one that is
/// left out has had no room on the line, or was damaged there.
struct Streamed {
  static constexpr std::uint8_t kind = 0xC0;
  std::uint16_t number;   ///< wraps
  std::uint8_t channels;  ///< bit i: Channel i
  std::uint32_t period;   ///< of the values; carrier periods served since reset, wraps
  std::array<std::uint32_t, channel_count> values;  ///< of those channels, at their places

  bool has(std::size_t channel) const { return (channels >> channel & 1U) != 0; }
};

namespace detail {
inline constexpr std::size_t first_value = sizeof(Streamed::channels) + sizeof(Streamed::period);
}

/// The frame of a sample: its channels, its period and the values of its channels alone.
inline Frame frame_of(const Streamed& sample) {
  static_assert(detail::first_value + channel_count * sizeof(std::uint32_t) <= most_payload_bytes);
  Frame frame;
  frame.kind = Streamed::kind;
  frame.sequence = sample.number;
  detail::append(sample.channels, sizeof sample.channels, frame);
  detail::append(sample.period, sizeof sample.period, frame);
  for (std::size_t i = 0; i < channel_count; ++i) {
    if (sample.has(i)) {
      detail::append(sample.values[i], sizeof sample.values[i], frame);
    }
  }
  return frame;
}

/// Reads a sample from its frame.
/// @return false where the frame is of another kind or length.
inline bool read(const Frame& frame, Streamed& sample) {
  if (frame.kind != Streamed::kind || frame.payload_bytes < detail::first_value) {
    return false;
  }
  sample = {frame.sequence, frame.payload[0], detail::field_at(1, sizeof sample.period, frame), {}};
  std::size_t at = detail::first_value;
  for (std::size_t i = 0; i < channel_count && at < frame.payload_bytes; ++i) {
    if (sample.has(i)) {
      sample.values[i] = detail::field_at(at, sizeof sample.values[i], frame);
      at += sizeof sample.values[i];
    }
  }
  return at == frame.payload_bytes && frame_of(sample).payload_bytes == at;
}

}  // namespace sonoglide::link
