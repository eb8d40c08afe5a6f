#include "host_sim/long_work/work.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace sonoglide::long_work::shard_test {
namespace {

RC_GTEST_PROP(ShardTest, TogetherTheyAreAllPointsInOrder, ()) {
  const std::uint64_t points = *rc::gen::inRange<std::uint64_t>(0, 1'000'000'000'001);
  const std::uint64_t count = *rc::gen::inRange<std::uint64_t>(1, 200);
  std::uint64_t next = 0;
  for (std::uint64_t number = 1; number <= count; ++number) {
    const PointRange range = Shard{number, count}.range(points);
    RC_ASSERT(range.first == next);
    RC_ASSERT(range.size() == points / count || range.size() == points / count + 1);
    next = range.end;
  }
  RC_ASSERT(next == points);
}

TEST(ShardTest, TheLastOfTheMostTakesTheLastOfTheMostPoints) {
  const PointRange range = Shard{most_shards, most_shards}.range(1'000'000'000'000);
  EXPECT_EQ(range.first, 999'999'000'000U);
  EXPECT_EQ(range.end, 1'000'000'000'000U);
}

TEST(ShardTest, ReadsKOfN) {
  const auto shard = parse_shard("3/8");
  ASSERT_TRUE(shard);
  EXPECT_EQ(shard->number, 3U);
  EXPECT_EQ(shard->count, 8U);
  EXPECT_TRUE(parse_shard("1/1"));
  EXPECT_TRUE(parse_shard("1000000/1000000"));
  for (const char* text : {"", "/", "3", "3/", "/8", "0/8", "9/8", "03/8", "3/08", "3/8 ", " 3/8",
                           "-3/8", "+3/8", "3/8/8", "1/1000001", "1/99999999999999999999999"}) {
    EXPECT_FALSE(parse_shard(text)) << text;
  }
}

TEST(ShardTest, FilesHaveNamesThatReadBack) {
  const auto rows = parse_file_name(rows_name({3, 8}));
  ASSERT_TRUE(rows);
  EXPECT_EQ(rows->kind, ShardFileName::Kind::rows);
  EXPECT_EQ(rows->shard.number, 3U);
  EXPECT_EQ(rows->shard.count, 8U);
  const auto journal = parse_file_name(journal_name({3, 8}, "node-7"));
  ASSERT_TRUE(journal);
  EXPECT_EQ(journal->kind, ShardFileName::Kind::journal);
  EXPECT_EQ(copy_of({3, 8}, journal_name({3, 8}, "node-7")), "node-7");
  EXPECT_FALSE(parse_file_name(staged_name({3, 8}, "node-7")));
  for (const char* name :
       {"shard_3_of_8", "shard_3_of_8.rows~", ".shard_3_of_8.rows.node", "shard_9_of_8.rows",
        "shard_3_of_8.journal", "shard__of_8.rows", "shard_03_of_8.rows", "sweep.csv", ""}) {
    EXPECT_FALSE(parse_file_name(name)) << name;
  }
}

}  // namespace
}  // namespace sonoglide::long_work::shard_test
