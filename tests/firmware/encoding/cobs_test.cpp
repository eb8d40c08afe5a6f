#include "firmware/encoding/cobs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sonoglide::encoding::cobs_test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Event = CobsDecoder::Event;

Bytes stuffed(const Bytes& bytes) {
  Bytes result(cobs_size(bytes.size()));
  CobsEncoder encoder(result.data());
  for (const std::uint8_t byte : bytes) {
    encoder.add(byte);
  }
  result.resize(encoder.finish());
  return result;
}

struct Unstuffed {
  Bytes bytes;
  Event last = Event::nothing;
};

Unstuffed unstuffed(const Bytes& stuffed) {
  CobsDecoder decoder;
  Unstuffed result;
  Bytes stream = stuffed;
  stream.push_back(cobs_delimiter);
  for (const std::uint8_t received : stream) {
    std::uint8_t byte = 0;
    result.last = decoder.take(received, byte);
    if (result.last == Event::byte) {
      result.bytes.push_back(byte);
    }
  }
  return result;
}

/// from, from + 1, … to.
Bytes run(int from, int to) {
  Bytes bytes;
  for (int i = from; i <= to; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(i));
  }
  return bytes;
}

Bytes joined(const Bytes& a, const Bytes& b) {
  Bytes bytes = a;
  bytes.insert(bytes.end(), b.begin(), b.end());
  return bytes;
}

// The start of an IP header, the worked example of Cheshire and Baker.
TEST(CobsTest, StuffsThePublishedExample) {
  const Bytes packet{0x45, 0x00, 0x00, 0x2C, 0x4C, 0x79, 0x00, 0x00, 0x40, 0x06, 0x4F, 0x37};
  const Bytes expected{0x02, 0x45, 0x01, 0x04, 0x2C, 0x4C, 0x79,
                       0x01, 0x05, 0x40, 0x06, 0x4F, 0x37};
  EXPECT_EQ(stuffed(packet), expected);
}

// Their rule: a code n is n - 1 bytes and a zero, 255 is 254 bytes and none; the last zero is not
// of the record.
TEST(CobsTest, FollowsThePublishedRuleAtItsEdges) {
  EXPECT_EQ(stuffed({}), (Bytes{1}));
  EXPECT_EQ(stuffed({0}), (Bytes{1, 1}));
  EXPECT_EQ(stuffed({0, 0}), (Bytes{1, 1, 1}));
  EXPECT_EQ(stuffed({7}), (Bytes{2, 7}));
  EXPECT_EQ(stuffed(run(1, 253)), joined({254}, run(1, 253)));
  EXPECT_EQ(stuffed(run(1, 254)), joined({255}, run(1, 254)));
  EXPECT_EQ(stuffed(run(1, 255)), joined(joined({255}, run(1, 254)), {2, 255}));
  EXPECT_EQ(stuffed(joined(run(1, 254), {0})), joined(joined({255}, run(1, 254)), {1, 1}));
}

rc::Gen<Bytes> records() {
  const auto byte = rc::gen::weightedElement<std::uint8_t>({{3, 0}, {3, 255}, {200, 1}, {1, 7}});
  return rc::gen::mapcat(rc::gen::inRange<std::size_t>(0, 1200), [byte](std::size_t size) {
    return rc::gen::container<Bytes>(size, byte);
  });
}

RC_GTEST_PROP(CobsTest, HoldsNoDelimiterAndComesBack, ()) {
  const Bytes record = *records();
  const Bytes wire = stuffed(record);
  RC_ASSERT(std::find(wire.begin(), wire.end(), cobs_delimiter) == wire.end());
  RC_ASSERT(wire.size() <= cobs_size(record.size()));
  const Unstuffed back = unstuffed(wire);
  RC_ASSERT(back.bytes == record);
  RC_ASSERT(back.last == Event::end);
}

TEST(CobsTest, TellsACutBlockFromAnEndAndFromAnIdleLine) {
  EXPECT_EQ(unstuffed({3, 9}).last, Event::cut);
  EXPECT_EQ(unstuffed({3, 9, 9}).last, Event::end);
  EXPECT_EQ(unstuffed({}).last, Event::idle);
}

TEST(CobsTest, ARecordHasBegunFromItsFirstCodeToItsDelimiter) {
  CobsDecoder decoder;
  std::uint8_t byte = 0;
  EXPECT_FALSE(decoder.begun());
  decoder.take(cobs_delimiter, byte);
  EXPECT_FALSE(decoder.begun());
  for (const int received : {2, 17, 1}) {
    decoder.take(static_cast<std::uint8_t>(received), byte);
    EXPECT_TRUE(decoder.begun());
  }
  decoder.take(cobs_delimiter, byte);
  EXPECT_FALSE(decoder.begun());
}

}  // namespace
}  // namespace sonoglide::encoding::cobs_test
