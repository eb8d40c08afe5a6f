#include "host_sim/long_work/kept_points.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tests/host_sim/long_work/folders/shard_folder.hpp"

namespace sonoglide::long_work::kept_points_test {
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

/// The record of a point is its number; how many were computed is counted.
class KeptPointsTest : public testing::Test {
 protected:
  static constexpr PointRange range{first, first + points_per_block + 5};

  /// Computes what the journal does not hold; all records in their order.
  std::vector<std::string> run() {
    computed_ = 0;
    KeptPoints points(range, {[this](const PointRange&, const std::vector<std::uint64_t>& open,
                                     const Sink& sink) {
                                for (std::size_t i = open.size(); i-- > 0;) {
                                  sink({{open[i], std::to_string(open[i])}});
                                }
                                computed_ += open.size();
                              },
                              [](std::string_view text) { return facts(text); }});
    Journal journal(folder_.path() / "journal", {"sweep", "--vary"}, {"p", "s", "o"},
                    [&points](std::string_view record) { return points.take(record); });
    found_ = points.finished();
    Pace pace(nobody_);
    EXPECT_TRUE(points.compute(journal, pace));
    std::vector<std::string> records;
    points.for_each_record(journal, [&](std::uint64_t point, const std::string& record) {
      EXPECT_EQ(record, std::to_string(point));
      records.push_back(record);
      return true;
    });
    return records;
  }

  std::size_t found_ = 0;
  std::size_t computed_ = 0;
  ShardFolder folder_;

 private:
  static std::optional<RecordFacts> facts(std::string_view text) {
    std::uint64_t point = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), point);
    return error == std::errc() && end == text.data() + text.size()
               ? std::optional<RecordFacts>({point, false})
               : std::nullopt;
  }

  Progress nobody_;
};

TEST_F(KeptPointsTest, ComputesEachOnceAndGivesAllInTheirOrder) {
  const std::vector<std::string> all = run();
  EXPECT_EQ(all.size(), range.size());
  EXPECT_EQ(computed_, range.size());
  EXPECT_EQ(run(), all);
  EXPECT_EQ(computed_, 0U);
  EXPECT_EQ(found_, range.size());
}

TEST_F(KeptPointsTest, GoesOnWhereTheJournalWasCut) {
  const std::vector<std::string> all = run();
  const std::string whole = folder_.read("journal");
  for (const std::size_t part : {std::size_t{3}, std::size_t{2}}) {
    folder_.write("journal", whole.substr(0, whole.size() / part * (part - 1)));
    EXPECT_EQ(run(), all);
    EXPECT_GT(found_, 0U);
    EXPECT_EQ(computed_, range.size() - found_);
  }
}

TEST_F(KeptPointsTest, APointBeyondTheRangeIsDamage) {
  folder_.write("journal", "");
  const std::vector<std::string> all = run();
  const std::string whole = folder_.read("journal");
  folder_.write("journal", whole + sealed(std::to_string(range.end)) + '\n');
  EXPECT_EQ(run(), all);
  EXPECT_EQ(folder_.read("journal"), whole);
}

}  // namespace
}  // namespace sonoglide::long_work::kept_points_test
