#include "host_sim/long_work/run_shard.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/host_sim/long_work/folders/shard_folder.hpp"

namespace sonoglide::long_work::shard_journal_test {
namespace {

const ShardHeader second{small_work(), 2};

class ShardJournalTest : public testing::Test {
 protected:
  ShardJournal open(const ShardHeader& header = second) {
    found_.clear();
    return {folder_.path(), header, [this](std::string_view record) {
              found_.emplace_back(record);
              return true;
            }};
  }
  static void append(ShardJournal& journal, const std::string& record) {
    journal.file().append({{0, record}});
  }

  ShardFolder folder_;
  std::vector<std::string> found_;
};

TEST_F(ShardJournalTest, GoesOnFromItsOwn) {
  {
    ShardJournal journal = open();
    append(journal, "a");
  }
  ShardJournal again = open();
  EXPECT_EQ(found_, std::vector<std::string>{"a"});
  EXPECT_EQ(journals_of(folder_.path(), {2, 4}),
            std::vector<std::filesystem::path>{again.file().path()});
}

TEST_F(ShardJournalTest, GoesOnFromThatOfAnotherNodeAndLeavesIt) {
  {
    ShardJournal journal = open();
    append(journal, "a");
    append(journal, "b");
    std::filesystem::rename(journal.file().path(),
                            folder_.path() / "shard_2_of_4.elsewhere.journal");
  }
  const std::string theirs = folder_.read("shard_2_of_4.elsewhere.journal");
  folder_.write("shard_2_of_4.elsewhere.journal", theirs + "a torn en");
  ShardJournal journal = open();
  EXPECT_EQ(found_, (std::vector<std::string>{"a", "b"}));
  append(journal, "c");
  EXPECT_EQ(folder_.read("shard_2_of_4.elsewhere.journal"), theirs + "a torn en");
}

TEST_F(ShardJournalTest, CopiesThatLiveHaveAFileEach) {
  ShardJournal one = open();
  append(one, "a");
  ShardJournal other = open();
  EXPECT_EQ(found_, std::vector<std::string>{"a"});
  EXPECT_NE(one.file().path(), other.file().path());
  EXPECT_NE(one.copy(), other.copy());
  append(one, "b");
  append(other, "c");
  EXPECT_EQ(journals_of(folder_.path(), {2, 4}).size(), 2U);
}

TEST_F(ShardJournalTest, ThoseOfCopiesThatLiveStayBehind) {
  ShardJournal living = open();
  {
    const ShardJournal ended = open();
    const ShardJournal of_another_shard = open({small_work(), 3});
  }
  remove_journals(folder_.path(), {2, 4});
  EXPECT_EQ(journals_of(folder_.path(), {2, 4}),
            std::vector<std::filesystem::path>{living.file().path()});
  EXPECT_EQ(journals_of(folder_.path(), {3, 4}).size(), 1U);
}

TEST_F(ShardJournalTest, WhatAKilledCopyWasAboutToPublishGoesToo) {
  const std::string copy = open().copy();
  folder_.write(staged_name({2, 4}, copy), "half of it");
  remove_journals(folder_.path(), {2, 4});
  EXPECT_TRUE(folder_.has_no_shard());
}

TEST_F(ShardJournalTest, OtherWorkIsRefusedByName) {
  {
    ShardJournal journal = open();
    std::filesystem::rename(journal.file().path(),
                            folder_.path() / "shard_2_of_4.elsewhere.journal");
  }
  ShardHeader other = second;
  other.work.scene = "[other]\n";
  try {
    open(other);
    FAIL();
  } catch (const ForeignJournal& error) {
    EXPECT_NE(std::string(error.what())
                  .find("shard_2_of_4.elsewhere.journal: holds an unfinished "
                        "sweep in shards of another scene"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(ShardJournalTest, ItsHeaderReadsBack) {
  ShardJournal journal = open();
  const auto header = journal_header(journal.file().path());
  ASSERT_TRUE(header);
  EXPECT_EQ(header->number, 2U);
  EXPECT_TRUE(difference(header->work, small_work()).none());
}

}  // namespace
}  // namespace sonoglide::long_work::shard_journal_test
