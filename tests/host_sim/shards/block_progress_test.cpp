#include "host_sim/shards/block_progress.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace sonoglide::shards::block_progress_test {
namespace {

constexpr std::uint64_t first = 1'000'000'007;

TEST(BlockProgressTest, GoesFromBlockToBlock) {
  BlockProgress progress({first, first + 2 * points_per_block + 1});
  for (const std::uint64_t size : {points_per_block, points_per_block, std::uint64_t{1}}) {
    EXPECT_FALSE(progress.complete());
    const PointRange block = progress.block();
    EXPECT_EQ(block.size(), size);
    EXPECT_EQ(progress.open_points().size(), size);
    for (std::uint64_t point = block.end; point-- > block.first;) {
      EXPECT_TRUE(progress.take(point));
    }
  }
  EXPECT_TRUE(progress.complete());
  EXPECT_EQ(progress.finished(), 2 * points_per_block + 1);
  EXPECT_TRUE(progress.open_points().empty());
}

TEST(BlockProgressTest, TakesWhatIsOpenInTheBlockAndNothingElse) {
  BlockProgress progress({first, first + points_per_block + 1});
  EXPECT_TRUE(progress.take(first + 2));
  EXPECT_FALSE(progress.take(first + 2)) << "twice";
  EXPECT_FALSE(progress.take(first - 1));
  EXPECT_FALSE(progress.take(first + points_per_block)) << "of the next block";
  EXPECT_EQ(progress.finished(), 1U);
  EXPECT_EQ(progress.open_points().size(), points_per_block - 1);
  EXPECT_EQ(progress.open_points()[2], first + 3);
}

TEST(BlockProgressTest, OfNoPointsItIsComplete) {
  const BlockProgress progress({first, first});
  EXPECT_TRUE(progress.complete());
  EXPECT_EQ(progress.finished(), 0U);
}

}  // namespace
}  // namespace sonoglide::shards::block_progress_test
