#include "host_sim/process/checksum.hpp"

#include <gtest/gtest.h>

namespace sonoglide::process::checksum_test {
namespace {

TEST(ChecksumTest, MatchesThePublishedVectors) {
  // draft-eastlake-fnv, FNV-1a 64.
  static_assert(checksum("") == 0xcbf29ce484222325U);
  static_assert(checksum("a") == 0xaf63dc4c8601ec8cU);
  static_assert(checksum("foobar") == 0x85944171f73967e8U);
}

TEST(ChecksumTest, IsTheSamePieceByPiece) {
  Checksum pieces;
  pieces.add("foo");
  pieces.add("");
  pieces.add("bar");
  EXPECT_EQ(pieces.value(), checksum("foobar"));
}

}  // namespace
}  // namespace sonoglide::process::checksum_test
