#include "firmware/link/sequence.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace sonoglide::link::sequence_test {
namespace {

TEST(SequenceWatchTest, TakesWhateverComesFirst) {
  for (const int first : {0, 1, 40000, 65535}) {
    SequenceWatch watch;
    EXPECT_EQ(watch.take(static_cast<std::uint16_t>(first)), Turn::next);
    EXPECT_EQ(watch.last(), first);
  }
}

TEST(SequenceWatchTest, CountsOnAcrossTheWrap) {
  SequenceWatch watch;
  for (int i = 65000; i < 66000; ++i) {
    EXPECT_EQ(watch.take(static_cast<std::uint16_t>(i)), Turn::next);
  }
}

// Every distance there is: what is newer moves the watch, what is not leaves it.
TEST(SequenceWatchTest, JudgesEveryDistance) {
  for (const std::uint16_t last : {std::uint16_t{0}, std::uint16_t{65535}, std::uint16_t{1234}}) {
    for (int ahead = 0; ahead < 65536; ++ahead) {
      SequenceWatch watch;
      watch.take(last);
      const auto sequence = static_cast<std::uint16_t>(last + ahead);
      const Turn turn = watch.take(sequence);
      const Turn expected = ahead == 0       ? Turn::repeated
                            : ahead == 1     ? Turn::next
                            : ahead < 0x8000 ? Turn::skipped
                                             : Turn::late;
      ASSERT_EQ(turn, expected) << ahead;
      const bool newer = expected == Turn::next || expected == Turn::skipped;
      ASSERT_EQ(watch.last(), newer ? sequence : last) << ahead;
    }
  }
}

TEST(SequenceWatchTest, KnowsFramesOutOfOrder) {
  SequenceWatch watch;
  watch.take(10);
  EXPECT_EQ(watch.take(12), Turn::skipped);
  EXPECT_EQ(watch.take(11), Turn::late);
  EXPECT_EQ(watch.take(12), Turn::repeated);
  EXPECT_EQ(watch.take(13), Turn::next);
}

TEST(SequenceWatchTest, OfAnotherSenderTakesWhateverComesFirst) {
  SequenceWatch watch;
  watch.take(1000);
  ASSERT_EQ(watch.take(7), Turn::late);
  watch.restart();
  EXPECT_EQ(watch.take(7), Turn::next);
  EXPECT_EQ(watch.take(8), Turn::next);
}

}  // namespace
}  // namespace sonoglide::link::sequence_test
