#include "host_sim/long_work/rows_file.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "host_sim/process/file_error.hpp"
#include "tests/host_sim/long_work/folders/shard_folder.hpp"

namespace sonoglide::long_work::rows_file_test {
namespace {

constexpr const char* second = "shard_2_of_4.rows";

std::vector<std::string> records(const std::filesystem::path& file) {
  RowsReader rows(file);
  std::vector<std::string> all;
  for (std::string record; rows.next(record);) {
    all.push_back(record);
  }
  return all;
}

TEST(RowsFileTest, GivesBackWhatItWasGiven) {
  const ShardFolder folder;
  folder.publish(2);
  EXPECT_EQ(records(folder.path() / second), (std::vector<std::string>{"2", "3", "4"}));
  const RowsReader rows(folder.path() / second);
  EXPECT_EQ(rows.header().number, 2U);
  EXPECT_TRUE(difference(rows.header().work, small_work()).none());
}

TEST(RowsFileTest, AShardWithoutPointsIsAFileTheSame) {
  const ShardFolder folder;
  Work work = small_work();
  work.points = 3;
  folder.publish(1, work);
  EXPECT_EQ(records(folder.path() / "shard_1_of_4.rows"), std::vector<std::string>{});
}

TEST(RowsFileTest, AnyByteThatIsLostOrChangedShows) {
  const ShardFolder folder;
  folder.publish(2);
  const std::string whole = folder.read(second);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    folder.write("cut", whole.substr(0, at));
    EXPECT_THROW(records(folder.path() / "cut"), DamagedRows) << at;
    std::string changed = whole;
    changed[at] = changed[at] == '3' ? '4' : '3';
    folder.write("changed", changed);
    EXPECT_THROW(records(folder.path() / "changed"), DamagedRows) << at;
  }
  folder.write("longer", whole + "\n");
  EXPECT_THROW(records(folder.path() / "longer"), DamagedRows);
}

TEST(RowsFileTest, WithoutPublicationNothingIsLeft) {
  const ShardFolder folder;
  {
    RowsWriter rows(folder.path(), {small_work(), 2}, "test");
    rows.add("2");
  }
  EXPECT_TRUE(folder.has_no_shard());
}

TEST(RowsFileTest, AFullDiskIsAnErrorAndLeavesNothing) {
  const ShardFolder folder;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{100, before.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(folder.publish(2), process::FileError);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_TRUE(folder.has_no_shard());
}

}  // namespace
}  // namespace sonoglide::long_work::rows_file_test
