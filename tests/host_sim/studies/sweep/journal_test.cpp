#include "host_sim/studies/sweep/journal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "host_sim/output/output_folder.hpp"
#include "tests/host_sim/studies/sweep/scenes/scratch_scene.hpp"

namespace sonoglide::sweep::journal_test {
namespace {

const Identity ours{"sonoglide 1", "{\"plant\":{}}", "a.b=1:2:3"};
constexpr std::size_t points = 100;

class JournalTest : public testing::Test {
 protected:
  std::filesystem::path file() const { return scratch_.folder() / "sweep.journal"; }
  std::string content() const {
    std::ifstream file_stream(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file_stream), std::istreambuf_iterator<char>()};
  }
  void set_content(const std::string& text) const {
    std::ofstream(file(), std::ios::binary) << text;
  }
  void write_points(std::size_t begin, std::size_t end) const {
    Journal journal(scratch_.folder(), ours, points);
    for (std::size_t point = begin; point < end; ++point) {
      journal.append(Journal::text_of({{point, {}}}));
    }
  }
  std::size_t finished() const {
    return Journal(scratch_.folder(), ours, points).finished().size();
  }
  std::string refusal(const Identity& identity) const {
    try {
      const Journal journal(scratch_.folder(), identity, points);
    } catch (const ForeignJournal& error) {
      return error.what();
    }
    return "taken";
  }

  ScratchScene scratch_{""};
};

TEST_F(JournalTest, GivesBackWhatItWasGiven) {
  write_points(0, 3);
  write_points(3, 5);
  const Journal journal(scratch_.folder(), ours, points);
  ASSERT_EQ(journal.finished().size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(journal.finished()[i].point, i);
  }
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
  text[second + 20] ^= 1;
  set_content(text);
  EXPECT_EQ(finished(), 1U);
}

TEST_F(JournalTest, APointBeyondTheGridIsDamage) {
  write_points(99, 100);
  EXPECT_EQ(Journal(scratch_.folder(), ours, 99).finished().size(), 0U);
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
  const Journal first(scratch_.folder(), ours, points);
  EXPECT_THROW(Journal(scratch_.folder(), ours, points), output::OutputError);
}

TEST_F(JournalTest, GoesWhenTheSweepIsWhole) {
  Journal journal(scratch_.folder(), ours, points);
  journal.remove();
  EXPECT_FALSE(std::filesystem::exists(file()));
}

}  // namespace
}  // namespace sonoglide::sweep::journal_test
