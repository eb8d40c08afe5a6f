/// How the fields of a message become the payload of a frame.
///
/// A message is a struct with a kind and its fields in the order of the wire.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/link/frame.hpp"

namespace sonoglide::link {

/// A kind with this bit answers the kind without it.
inline constexpr std::uint8_t answer_bit = 0x80;

/// Bytes of a message's payload.
template <class Message>
constexpr std::size_t payload_bytes() {
  std::size_t size = 0;
  Message message{};
  Message::fields(message, [&size](auto field) { size += sizeof field; });
  return size;
}

namespace detail {

// Out of line: every field of every message would bring its own copy.

[[gnu::noinline]] inline void append(std::uint32_t value, std::size_t size, Frame& frame) {
  for (std::size_t i = 0; i < size; ++i, value >>= 8) {
    frame.payload[frame.payload_bytes++] = static_cast<std::uint8_t>(value);
  }
}

[[gnu::noinline]] inline std::uint32_t field_at(std::size_t begin, std::size_t size,
                                                const Frame& frame) {
  std::uint32_t value = 0;
  for (std::size_t i = begin + size; i > begin; --i) {
    value = value << 8 | frame.payload[i - 1];
  }
  return value;
}

}  // namespace detail

/// The frame of a message, its fields in their order.
template <class Message>
Frame frame_of(const Message& message, std::uint16_t sequence) {
  static_assert(payload_bytes<Message>() <= most_payload_bytes);
  Frame frame;
  frame.kind = Message::kind;
  frame.sequence = sequence;
  Message::fields(message, [&frame](auto field) {
    detail::append(static_cast<std::uint32_t>(field), sizeof field, frame);
  });
  return frame;
}

/// Reads a message from its frame.
/// @return false where the frame is of another kind or length.
template <class Message>
bool read(const Frame& frame, Message& message) {
  if (frame.kind != Message::kind || frame.payload_bytes != payload_bytes<Message>()) {
    return false;
  }
  std::size_t at = 0;
  Message::fields(message, [&frame, &at](auto& field) {
    using Field = std::remove_reference_t<decltype(field)>;
    field = static_cast<Field>(detail::field_at(at, sizeof field, frame));
    at += sizeof field;
  });
  return true;
}

}  // namespace sonoglide::link
