#include "host_sim/long_work/collection.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "host_sim/long_work/run_shard.hpp"
#include "tests/host_sim/long_work/folders/shard_folder.hpp"

namespace sonoglide::long_work::collection_test {
namespace {

using Numbers = std::vector<std::uint64_t>;

class CollectionTest : public testing::Test {
 protected:
  void publish_all_but(const Numbers& left_out) const {
    for (std::uint64_t number = 1; number <= 4; ++number) {
      if (std::find(left_out.begin(), left_out.end(), number) == left_out.end()) {
        folder_.publish(number);
      }
    }
  }
  std::vector<std::string> records() const {
    std::vector<std::string> all;
    Collection(folder_.path()).for_each_record([&](std::uint64_t point, const std::string& record) {
      EXPECT_EQ(record, std::to_string(point));
      all.push_back(record);
      return true;
    });
    return all;
  }
  /// Of a shard of other work beside the first.
  std::string refusal(const std::function<void(Work&)>& change) const {
    folder_.publish(1);
    Work other = small_work();
    change(other);
    folder_.publish(2, other);
    try {
      const Collection found(folder_.path());
    } catch (const UnusableShards& error) {
      return error.what();
    }
    return "taken";
  }
  std::string shown(const char* name) const { return (folder_.path() / name).string(); }

  ShardFolder folder_;
};

TEST_F(CollectionTest, ReadsAllInTheOrderOfThePoints) {
  publish_all_but({});
  EXPECT_EQ(records().size(), 10U);
  EXPECT_EQ(records().back(), "9");
}

TEST_F(CollectionTest, NamesWhatIsMissing) {
  publish_all_but({1, 3, 4});
  try {
    records();
    FAIL();
  } catch (const Incomplete& error) {
    EXPECT_EQ(error.missing(), (Numbers{1, 3, 4}));
    EXPECT_EQ(error.what(), folder_.path().string() +
                                ": 3 of 4 shards are missing; run them again: --array=1,3-4");
  }
}

TEST_F(CollectionTest, NamesEveryOneThatIsDamaged) {
  publish_all_but({});
  folder_.write("shard_4_of_4.rows", "nothing of a shard");
  const std::string second = folder_.read("shard_2_of_4.rows");
  folder_.write("shard_2_of_4.rows", second.substr(0, second.size() - 40));
  std::size_t taken = 0;
  try {
    Collection(folder_.path()).for_each_record([&](std::uint64_t, const std::string&) {
      ++taken;
      return true;
    });
    FAIL();
  } catch (const Incomplete& error) {
    EXPECT_EQ(error.missing(), (Numbers{2, 4}));
    EXPECT_NE(std::string(error.what()).find(shown("shard_2_of_4.rows") + " is damaged in line 5"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find(shown("shard_4_of_4.rows") + " does not begin as"),
              std::string::npos);
  }
  EXPECT_LE(taken, 5U);
}

TEST_F(CollectionTest, WhatDoesNotBelongTogetherIsRefusedByName) {
  EXPECT_EQ(refusal([](Work& work) { work.arithmetic = "scalars"; }),
            shown("shard_1_of_4.rows") + " has arithmetic lanes and " + shown("shard_2_of_4.rows") +
                " has arithmetic scalars; allowed: shards of one command and one program");
  EXPECT_NE(refusal([](Work& work) { work.program = "sonoglide 2"; }).find("program sonoglide 2;"),
            std::string::npos);
  EXPECT_NE(refusal([](Work& work) {
              work.options = {"c.d=1:3:10"};
            }).find("options \"c.d=1:2:10\" and "),
            std::string::npos);
  EXPECT_NE(refusal([](Work& work) { work.scene += "# seen\n"; }).find("has a scene of checksum"),
            std::string::npos);
}

TEST_F(CollectionTest, AnotherNumberOfShardsIsRefusedByName) {
  folder_.publish(1);
  Work other = small_work();
  other.shards = 5;
  folder_.publish(2, other);
  EXPECT_THROW(Collection(folder_.path()), UnusableShards);
}

TEST_F(CollectionTest, AShardThatWasRenamedIsRefused) {
  folder_.publish(1);
  folder_.write("shard_3_of_4.rows", folder_.read("shard_1_of_4.rows"));
  EXPECT_THROW(Collection(folder_.path()), UnusableShards);
}

TEST_F(CollectionTest, AnEmptyFolderHoldsNoShard) {
  EXPECT_THROW(Collection(folder_.path()), UnusableShards);
}

TEST_F(CollectionTest, KnowsWhatHasBegun) {
  publish_all_but({2, 3});
  ShardJournal journal(folder_.path(), {small_work(), 3}, [](std::string_view) { return true; });
  journal.file().append({{5, "5"}});
  const Collection found(folder_.path());
  EXPECT_EQ(found.missing(), (Numbers{2, 3}));
  EXPECT_EQ(found.points_there(), 5U);
  ASSERT_EQ(found.begun().size(), 1U);
  EXPECT_EQ(found.begun()[0].number, 3U);
  EXPECT_EQ(found.begun()[0].finished, 1U);
  EXPECT_EQ(found.begun()[0].points, 2U);
}

/// None of them is waited for or read to an end that never comes.
TEST_F(CollectionTest, AFifoOrAnEndlessFileIsADamagedShard) {
  publish_all_but({2, 3});
  ASSERT_EQ(mkfifo((folder_.path() / "shard_2_of_4.rows").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((folder_.path() / "shard_2_of_4.node.journal").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder_.path() / "shard_3_of_4.rows");
  EXPECT_EQ(Collection(folder_.path()).missing(), (Numbers{2, 3}));
}

TEST_F(CollectionTest, AnEndlessFirstLineIsNone) {
  publish_all_but({3});
  const std::filesystem::path file = folder_.path() / "shard_3_of_4.rows";
  std::ofstream(file).put('x');
  std::filesystem::resize_file(file, std::uintmax_t{1} << 40U);  // without blocks
  EXPECT_EQ(Collection(folder_.path()).missing(), Numbers{3});
}

TEST_F(CollectionTest, ShardsOfAnotherCommandAreNamed) {
  publish_all_but({});
  const Collection found(folder_.path());
  EXPECT_NO_THROW(found.require_kind(small_work().kind));
  EXPECT_THROW(found.require_kind("robust"), UnusableShards);
}

}  // namespace
}  // namespace sonoglide::long_work::collection_test
