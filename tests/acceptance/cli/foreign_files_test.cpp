/// Files that somebody else has put where an output goes.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "short_scenes.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::foreign_files_test {
namespace {

// An option that changes what is written leaves what the program checks.
TEST(ForeignFileTest, IsKeptWithOtherOptions) {
  const std::vector<std::pair<std::string, std::string>> commands = {
      {"run open.toml --out . --json", "report.html"},
      {"sweep open.toml --out . --vary velocity_ratio=0.1:0.1:1", "sweep.svg"},
      {"paper --out .", "balance.csv"},
  };
  for (const auto& [arguments, file] : commands) {
    const ScratchFolder folder;
    folder.write("open.toml", short_open_loop);
    folder.write(file, "mine");
    const std::vector<std::string> before = folder.entries();
    const Outcome outcome = folder.run(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("; allowed: "), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder.read(file), "mine") << arguments;
    EXPECT_EQ(folder.entries(), before) << arguments;
  }
}

TEST(ForeignFileTest, ALinkIsNoListAndNoJournal) {
  const ScratchFolder folder;
  folder.write("open.toml", short_open_loop);
  folder.write("file", "mine");
  for (const std::string name : {".sonoglide", "sweep.journal"}) {
    for (const char* linked : {"/dev/zero", "file", "nowhere"}) {
      std::filesystem::create_symlink(linked, folder.path() / name);
      const Outcome outcome = folder.run("sweep open.toml --out . --vary velocity_ratio=0.1:1:3");
      EXPECT_EQ(outcome.exit_code, 1) << name << linked << outcome.err;
      EXPECT_NE(outcome.err.find(name + ": is "), std::string::npos) << outcome.err;
      EXPECT_NE(outcome.err.find("; allowed: "), std::string::npos) << outcome.err;
      std::filesystem::remove(folder.path() / name);
    }
  }
  EXPECT_EQ(folder.read("file"), "mine");
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"file", "open.toml"}));
}

TEST(ForeignFileTest, OtherNamesAreNobodysBusiness) {
  const ScratchFolder folder;
  folder.write("open.toml", short_open_loop);
  EXPECT_EQ(folder.run("run open.toml --out . --quiet").exit_code, 0);
  EXPECT_EQ(folder.run("run open.toml --out . --quiet").exit_code, 0);
  EXPECT_EQ(folder.entries(),
            (std::vector<std::string>{".sonoglide", "open.toml", "report.html", "summary.json"}));
}

TEST(ForeignFileTest, AnOutputThatWasEditedIsTheUsers) {
  const ScratchFolder folder;
  folder.write("open.toml", short_open_loop);
  EXPECT_EQ(folder.run("run open.toml --out o --quiet").exit_code, 0);
  const std::string edited = folder.read("o/summary.json") + "\n";
  folder.write("o/summary.json", edited);
  EXPECT_EQ(folder.run("run open.toml --out o --quiet").exit_code, 1);
  EXPECT_EQ(folder.read("o/summary.json"), edited);
}

TEST(ForeignFileTest, CommandsReplaceEachOthersOutput) {
  const ScratchFolder folder;
  folder.write("open.toml", short_open_loop);
  EXPECT_EQ(folder.run("run open.toml --out o --quiet").exit_code, 0);
  EXPECT_EQ(folder.run("sweep open.toml --out o --quiet --vary velocity_ratio=0.1:1:3").exit_code,
            0);
  EXPECT_NE(folder.read("o/report.html").find("Sweep of open"), std::string::npos);
}

}  // namespace
}  // namespace sonoglide::acceptance::foreign_files_test
