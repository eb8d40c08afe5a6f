/// Frames on a wire that loses, alters and adds bytes.
#include "firmware/link/frame.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "firmware/link/messages.hpp"

namespace sonoglide::link {

bool operator==(const Frame& a, const Frame& b) {
  return a.kind == b.kind && a.sequence == b.sequence && a.payload_bytes == b.payload_bytes &&
         a.payload == b.payload;
}

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes wire_of(const Frame& frame) {
  const WireFrame wire = encode(frame);
  return {wire.bytes.begin(), wire.bytes.begin() + static_cast<std::ptrdiff_t>(wire.size)};
}

/// Any record as it would travel, with its delimiter.
Bytes stuffed(const Bytes& record) {
  Bytes stream(encoding::cobs_size(record.size()));
  encoding::CobsEncoder encoder(stream.data());
  for (const std::uint8_t byte : record) {
    encoder.add(byte);
  }
  stream.resize(encoder.finish());
  stream.push_back(encoding::cobs_delimiter);
  return stream;
}

struct Received {
  std::vector<Frame> frames;
  std::vector<Reception> faults;
};

Frame shortened(const Frame& frame) {
  Frame result = frame;
  std::fill(result.payload.begin() + frame.payload_bytes, result.payload.end(), std::uint8_t{0});
  return result;
}

Received received(const Bytes& stream) {
  FrameDecoder decoder;
  Received result;
  for (const std::uint8_t byte : stream) {
    const Reception reception = decoder.take(byte);
    if (reception == Reception::frame) {
      result.frames.push_back(shortened(decoder.frame()));
    } else if (reception != Reception::nothing) {
      result.faults.push_back(reception);
    }
  }
  return result;
}

/// One of each, with fields that vary by `seed`; zeros among them.
template <class... Messages>
std::vector<Frame> filled(std::uint32_t seed) {
  const auto number = [&seed](std::size_t bytes) {
    seed = 1664525U * seed + 1013904223U;
    return seed % 3 == 0 ? 0U : seed >> 8 * (sizeof seed - bytes);
  };
  std::vector<Frame> frames;
  const auto add = [&](auto message) {
    decltype(message)::fields(message, [&](auto& field) {
      field = static_cast<std::remove_reference_t<decltype(field)>>(number(sizeof field));
    });
    frames.push_back(frame_of(message, static_cast<std::uint16_t>(number(2))));
  };
  (add(Messages{}), ...);
  return frames;
}

std::vector<Frame> every_message(std::uint32_t seed) {
  return filled<ReadTelemetry, Telemetry, SetTarget, TargetSet, ReadParameter, ParameterValue,
                WriteParameter, ParameterWritten, Restart, Restarted, Stop, Stopped, Confirm,
                Confirmed, ReadFault, LoggedFault, Refusal>(seed);
}

/// Nothing that arrives differs from what was sent.
bool deceives(const Received& arrived, const Frame& sent) {
  return std::any_of(arrived.frames.begin(), arrived.frames.end(),
                     [&sent](const Frame& frame) { return !(frame == sent); });
}

TEST(FrameTest, EveryMessageArrives) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    for (const Frame& frame : every_message(seed)) {
      const Received arrived = received(wire_of(frame));
      ASSERT_EQ(arrived.frames.size(), 1U);
      ASSERT_TRUE(arrived.frames.front() == frame);
      ASSERT_TRUE(arrived.faults.empty());
    }
  }
}

// The layout that the documentation promises, byte for byte.
TEST(FrameTest, IsLaidOutAsDocumented) {
  const Bytes wire = wire_of(frame_of(SetTarget{450000}, 0x0102));
  // Version, kind, sequence low first, 450000 = 0x0006DDD0 low first, CRC-32 low first; stuffed.
  const Bytes record{2, 2, 0x02, 0x01, 0xD0, 0xDD, 0x06, 0x00};
  const std::uint32_t checksum = encoding::crc32(record.data(), record.size());
  Bytes expected{0, 8, 2, 2, 0x02, 0x01, 0xD0, 0xDD, 0x06, 5};
  for (int i = 0; i < 4; ++i) {
    expected.push_back(static_cast<std::uint8_t>(checksum >> (8 * i)));
  }
  expected.push_back(0);
  EXPECT_EQ(wire, expected);
  FrameDecoder decoder;
  for (const std::uint8_t byte : wire) {
    decoder.take(byte);
  }
  EXPECT_EQ(decoder.checksum(), checksum);
}

TEST(FrameEncoder, HasNothingForTheWireUntilAFrameIsWhole) {
  FrameEncoder encoder;
  EXPECT_FALSE(encoder.busy());
  EXPECT_EQ(encoder.wire().size, 0U);
  for (int frame = 0; frame < 2; ++frame) {
    encoder.begin(frame_of(SetTarget{450000}, 7));
    while (encoder.busy()) {
      ASSERT_EQ(encoder.wire().size, 0U) << frame;
      encoder.proceed();
    }
    EXPECT_EQ(encoder.wire().size, wire_of(frame_of(SetTarget{450000}, 7)).size()) << frame;
  }
}

/// Every pair of bits of a frame on the wire, its delimiters included, and every bit alone.
void expect_bit_errors_are_caught(const Frame& frame) {
  Bytes wire = wire_of(frame);
  const auto flip = [&wire](std::size_t bit) {
    wire[bit / 8] = static_cast<std::uint8_t>(wire[bit / 8] ^ (1U << (bit % 8)));
  };
  for (std::size_t first = 0; first < 8 * wire.size(); ++first) {
    flip(first);
    ASSERT_FALSE(deceives(received(wire), frame)) << int{frame.kind} << ": bit " << first;
    for (std::size_t second = 0; second < first; ++second) {
      flip(second);
      ASSERT_FALSE(deceives(received(wire), frame))
          << int{frame.kind} << ": bits " << first << " and " << second;
      flip(second);
    }
    flip(first);
  }
}

TEST(FrameTest, EverySingleAndDoubleBitErrorIsCaught) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    for (const Frame& frame : every_message(seed)) {
      expect_bit_errors_are_caught(frame);
    }
  }
}

// An error within the frame loses it: nothing that was altered passes, not even unchanged.
TEST(FrameTest, AnErrorBetweenTheDelimitersIsReported) {
  for (const Frame& frame : every_message(2)) {
    Bytes wire = wire_of(frame);
    for (std::size_t bit = 8; bit < 8 * (wire.size() - 1); ++bit) {
      Bytes altered = wire;
      altered[bit / 8] = static_cast<std::uint8_t>(altered[bit / 8] ^ (1U << (bit % 8)));
      const Received arrived = received(altered);
      ASSERT_TRUE(arrived.frames.empty()) << bit;
      ASSERT_FALSE(arrived.faults.empty()) << bit;
    }
  }
}

TEST(FrameTest, ATruncationAtAnyByteIsReportedAndTheNextFrameArrives) {
  for (const Frame& frame : every_message(3)) {
    const Bytes wire = wire_of(frame);
    for (std::size_t kept = 2; kept + 1 < wire.size(); ++kept) {
      Bytes stream(wire.begin(), wire.begin() + static_cast<std::ptrdiff_t>(kept));
      stream.insert(stream.end(), wire.begin(), wire.end());
      const Received arrived = received(stream);
      ASSERT_EQ(arrived.faults.size(), 1U) << kept;
      ASSERT_TRUE(arrived.faults.front() == Reception::truncated ||
                  arrived.faults.front() == Reception::corrupted)
          << kept;
      ASSERT_EQ(arrived.frames.size(), 1U) << kept;
      ASSERT_TRUE(arrived.frames.front() == frame);
    }
  }
}

TEST(FrameTest, AnOversizedFrameIsReportedOnce) {
  for (const std::size_t size : {most_frame_bytes + 1, most_frame_bytes + 2, std::size_t{5000}}) {
    const Bytes record(size, 0x55);
    Bytes stream = stuffed(record);
    const Bytes wire = wire_of(frame_of(ReadTelemetry{}, 5));
    stream.insert(stream.end(), wire.begin(), wire.end());
    const Received arrived = received(stream);
    EXPECT_EQ(arrived.faults, (std::vector<Reception>{Reception::oversized}));
    EXPECT_EQ(arrived.frames.size(), 1U);
  }
}

TEST(FrameTest, AnotherVersionIsReported) {
  Bytes record{version + 1, 1, 0, 0};
  const std::uint32_t checksum = encoding::crc32(record.data(), record.size());
  for (int i = 0; i < 4; ++i) {
    record.push_back(static_cast<std::uint8_t>(checksum >> (8 * i)));
  }
  const Bytes stream = stuffed(record);
  const Received arrived = received(stream);
  EXPECT_EQ(arrived.faults, (std::vector<Reception>{Reception::wrong_version}));
  EXPECT_TRUE(arrived.frames.empty());
}

RC_GTEST_PROP(FrameTest, GarbageCostsNoFrameThatFollowsIt, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const std::vector<Frame> sent = every_message(seed);
  Bytes stream;
  for (const Frame& frame : sent) {
    const auto garbage = *rc::gen::scale(2.0, rc::gen::arbitrary<Bytes>());
    stream.insert(stream.end(), garbage.begin(), garbage.end());
    const Bytes wire = wire_of(frame);
    stream.insert(stream.end(), wire.begin(), wire.end());
  }
  RC_ASSERT(received(stream).frames == sent);
}

RC_GTEST_PROP(FrameTest, NoiseIsNeverAFrame, (const Bytes& noise)) {
  RC_ASSERT(received(noise).frames.empty());
}

RC_GTEST_PROP(MessageTest, FieldsComeBack,
              (std::uint8_t parameter, std::uint32_t value, std::uint16_t sequence)) {
  const Frame frame = frame_of(WriteParameter{parameter, value}, sequence);
  WriteParameter back{};
  RC_ASSERT(read(frame, back));
  RC_ASSERT(back.parameter == parameter);
  RC_ASSERT(back.value == value);
  RC_ASSERT(frame.sequence == sequence);
}

TEST(MessageTest, AnotherKindOrLengthIsNotRead) {
  Frame frame = frame_of(SetTarget{1}, 0);
  SetTarget target{};
  ReadTelemetry telemetry{};
  EXPECT_TRUE(read(frame, target));
  EXPECT_FALSE(read(frame, telemetry));
  for (const int length : {0, 3, 5, 32}) {
    frame.payload_bytes = static_cast<std::uint8_t>(length);
    EXPECT_FALSE(read(frame, target)) << length;
  }
}

}  // namespace
}  // namespace sonoglide::link
