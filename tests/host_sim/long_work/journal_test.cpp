#include "host_sim/long_work/journal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/process/file_error.hpp"
#include "tests/host_sim/long_work/folders/shard_folder.hpp"

namespace sonoglide::long_work::journal_test {
namespace {

const Identity ours{"sonoglide 1", "{\"plant\":{}}", "a.b=1:2:3"};
constexpr JournalKind kind{"sweep", "--vary"};

class JournalTest : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_.path() / "sweep.journal"; }
  std::string content() const { return folder_.read("sweep.journal"); }
  void set_content(const std::string& text) const { folder_.write("sweep.journal", text); }
  /// The numbers that are found are added to a list.
  Journal open(std::vector<std::string>& found, const Identity& identity = ours) const {
    return {file(), kind, identity, [&found](std::string_view record) {
              found.emplace_back(record);
              return record != "unheard of";
            }};
  }
  void write_points(std::uint64_t begin, std::uint64_t end) const {
    std::vector<std::string> found;
    Journal journal = open(found);
    for (std::uint64_t point = begin; point < end; ++point) {
      journal.append({{point, std::to_string(point)}});
    }
  }
  std::size_t finished() const {
    std::vector<std::string> found;
    open(found);
    return found.size();
  }
  std::string refusal(const Identity& identity) const {
    try {
      std::vector<std::string> found;
      open(found, identity);
    } catch (const ForeignJournal& error) {
      return error.what();
    }
    return "taken";
  }

  ShardFolder folder_;
};

TEST_F(JournalTest, GivesBackWhatItWasGiven) {
  write_points(0, 3);
  write_points(3, 5);
  std::vector<std::string> found;
  const Journal journal = open(found);
  EXPECT_EQ(found, (std::vector<std::string>{"0", "1", "2", "3", "4"}));
}

TEST_F(JournalTest, CutAnywhereItKeepsTheWholeRecordsAndGoesOn) {
  write_points(0, 3);
  const std::string whole = content();
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    set_content(whole.substr(0, length));
    const auto lines =
        std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length), '\n');
    const std::size_t kept = lines == 0 ? 0 : static_cast<std::size_t>(lines) - 1;
    ASSERT_EQ(finished(), kept) << length;
    write_points(kept, 3);
    ASSERT_EQ(content(), whole) << length;
  }
}

TEST_F(JournalTest, NothingAfterADamagedRecordIsTaken) {
  write_points(0, 3);
  std::string text = content();
  const std::size_t second = text.find('\n', text.find('\n') + 1) + 1;
  text[second + 3] ^= 1;
  set_content(text);
  EXPECT_EQ(finished(), 1U);
}

TEST_F(JournalTest, ARecordThatNobodyTakesIsDamage) {
  write_points(0, 3);
  const std::string whole = content();
  {
    std::vector<std::string> found;
    open(found).append({{3, "unheard of"}, {4, "4"}});
  }
  finished();
  EXPECT_EQ(content(), whole);
}

TEST_F(JournalTest, ServesNoOtherSweepAndSaysWhy) {
  write_points(0, 3);
  const std::string before = content();
  EXPECT_NE(refusal({"sonoglide 2", ours.scene, ours.options}).find("of sonoglide 1;"),
            std::string::npos);
  EXPECT_NE(refusal({ours.program, "{}", ours.options}).find("of another scene;"),
            std::string::npos);
  EXPECT_NE(refusal({ours.program, ours.scene, ""}).find("of other --vary;"), std::string::npos);
  EXPECT_EQ(content(), before);
  set_content("mine, a line without an end");
  EXPECT_NE(refusal(ours).find("another format of journal"), std::string::npos);
  EXPECT_EQ(content(), "mine, a line without an end");
  set_content("mine\n");
  EXPECT_NE(refusal(ours).find("another format of journal"), std::string::npos);
  EXPECT_EQ(content(), "mine\n");
}

TEST_F(JournalTest, IsOneSweepsAtATime) {
  std::vector<std::string> found;
  const Journal first = open(found);
  EXPECT_THROW(open(found), process::FileError);
}

TEST_F(JournalTest, GoesWhenTheSweepIsWhole) {
  std::vector<std::string> found;
  open(found).remove();
  EXPECT_FALSE(std::filesystem::exists(file()));
}

}  // namespace
}  // namespace sonoglide::long_work::journal_test
