#include "hal/trace_hash.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace sonoglide::hal::trace_hash_test {
namespace {

__extension__ using Wide = unsigned __int128;

/// FNV-1a as its definition has it, with a wide product reduced modulo 2^64.
std::uint64_t fnv_1a(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash = static_cast<std::uint64_t>(Wide{hash} * Wide{1099511628211U} % (Wide{1} << 64));
  }
  return hash;
}

/// The twelve bytes of a command, as the hash is documented to take them.
std::string bytes_of(const Drive& drive) {
  std::string bytes;
  for (const std::int32_t code : {drive.amplitude, drive.commanded_ratio}) {
    auto rest = static_cast<std::int64_t>(code);
    rest = rest < 0 ? rest + (std::int64_t{1} << 32) : rest;
    for (int i = 0; i < 4; ++i, rest /= 256) {
      bytes.push_back(static_cast<char>(rest % 256));
    }
  }
  bytes.push_back(static_cast<char>(drive.state));
  bytes.push_back(static_cast<char>(drive.limit));
  bytes.push_back(static_cast<char>(drive.fault));
  bytes.push_back(static_cast<char>(drive.settling));
  return bytes;
}

// Published vectors of FNV-1a, 64 bits.
TEST(TraceHashTest, OfNothingIsTheOffsetBasis) {
  EXPECT_EQ(TraceHash().value(), 0xcbf29ce484222325U);
}

TEST(TraceHashTest, OracleGivesThePublishedVectors) {
  EXPECT_EQ(fnv_1a(""), 0xcbf29ce484222325U);
  EXPECT_EQ(fnv_1a("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(fnv_1a("foobar"), 0x85944171f73967e8U);
}

TEST(TraceHashTest, GoesThroughACourseOfCommandsInOrder) {
  TraceHash hash;
  std::string bytes;
  std::int32_t amplitude = INT32_MIN;
  for (int i = 0; i < 1000; ++i) {
    const Drive drive{amplitude,
                      amplitude / 3,
                      static_cast<std::uint8_t>(i),
                      static_cast<std::uint8_t>(3 * i),
                      static_cast<std::uint8_t>(255 - i),
                      static_cast<std::uint8_t>(7 * i)};
    hash.add(drive);
    bytes += bytes_of(drive);
    ASSERT_EQ(hash.value(), fnv_1a(bytes)) << i;
    amplitude += 4294967;
  }
}

TEST(TraceHashTest, OfASampleTakesItsTenBytesInOrder) {
  TraceHash hash;
  hash.add(Sample{0x04030201, 0x08070605, true, false});
  EXPECT_EQ(hash.value(), fnv_1a(std::string("\1\2\3\4\5\6\7\10\1\0", 10)));
  TraceHash other;
  other.add(Sample{-2, INT32_MIN, false, true});
  EXPECT_EQ(other.value(), fnv_1a(std::string("\xfe\xff\xff\xff\0\0\0\x80\0\1", 10)));
}

TEST(TraceHashTest, SeesEveryFieldAndTheLastBit) {
  const Drive drive{1000, 500, 2, 1, 0, 1};
  const auto hash_of = [](const Drive& command) {
    TraceHash hash;
    hash.add(command);
    return hash.value();
  };
  EXPECT_NE(hash_of(drive), hash_of({1001, 500, 2, 1, 0, 1}));
  EXPECT_NE(hash_of(drive), hash_of({1000, 501, 2, 1, 0, 1}));
  EXPECT_NE(hash_of(drive), hash_of({1000, 500, 3, 1, 0, 1}));
  EXPECT_NE(hash_of(drive), hash_of({1000, 500, 2, 0, 0, 1}));
  EXPECT_NE(hash_of(drive), hash_of({1000, 500, 2, 1, 16, 1}));
  EXPECT_NE(hash_of(drive), hash_of({1000, 500, 2, 1, 0, 2}));
}

}  // namespace
}  // namespace sonoglide::hal::trace_hash_test
