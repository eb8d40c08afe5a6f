#include "firmware/encoding/crc32.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <vector>

namespace sonoglide::encoding::crc32_test {
namespace {

std::uint32_t ours(const std::vector<std::uint8_t>& bytes) {
  return crc32(bytes.data(), bytes.size());
}

TEST(Crc32Test, GivesThePublishedCheckValue) {
  EXPECT_EQ(ours({'1', '2', '3', '4', '5', '6', '7', '8', '9'}), 0xCBF43926U);
  EXPECT_EQ(ours({}), 0U);
}

RC_GTEST_PROP(Crc32Test, IsThatOfZlib, (const std::vector<std::uint8_t>& bytes)) {
  RC_ASSERT(ours(bytes) == ::crc32(0, bytes.data(), static_cast<uInt>(bytes.size())));
}

RC_GTEST_PROP(Crc32Test, KnowsARecordThatEndsWithItsOwn,
              (const std::vector<std::uint8_t>& bytes, std::uint32_t other)) {
  Crc32 closed;
  Crc32 open;
  for (const std::uint8_t byte : bytes) {
    closed.add(byte);
    open.add(byte);
  }
  const std::uint32_t value = closed.value();
  closed.add_word(value);
  open.add_word(other);
  RC_ASSERT(closed.closed());
  RC_ASSERT(open.closed() == (other == value));
}

}  // namespace
}  // namespace sonoglide::encoding::crc32_test
