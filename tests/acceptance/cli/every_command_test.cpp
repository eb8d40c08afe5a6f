/// What every command does alike, from one table of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "command_table.hpp"
#include "scene_folder.hpp"

namespace sonoglide::acceptance::every_command_test {
namespace {

namespace fs = std::filesystem;
using Entries = std::vector<std::string>;

bool runs_here(const Command& command) {
  constexpr bool has_emulators = SONOGLIDE_BOARD_TESTS != 0;
  return has_emulators || command.effort != Effort::emulator;
}

std::vector<Command> commands_that(const std::function<bool(const Command&)>& condition) {
  std::vector<Command> found;
  std::copy_if(command_table.begin(), command_table.end(), std::back_inserter(found), condition);
  return found;
}

std::string test_name(const testing::TestParamInfo<Command>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

/// A command in a folder with the scenes.
class CommandTest : public testing::TestWithParam<Command> {
 protected:
  void expect_refused(const std::string& arguments, int exit_code, const std::string& error) const {
    const Entries before = folder_.entries();
    const Outcome outcome = folder_.run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(outcome.err, error) << arguments;
    EXPECT_EQ(folder_.entries(), before) << arguments;
  }
  void expect_usage_error(const std::string& arguments, const std::string& error) const {
    expect_refused(arguments, 2, "sonoglide: " + error + "\n" + usage_hint(command().name));
  }
  const Command& command() const { return GetParam(); }

  SceneFolder folder_;
};

class EveryCommandTest : public CommandTest {};

/// The long options of a help, in its order.
std::vector<std::string> options_in(const std::string& help) {
  std::vector<std::string> found;
  std::istringstream lines(help.substr(help.find("\nOptions:\n")));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find("--");
    if (begin != std::string::npos && line.find_first_not_of(' ') + 3 >= begin) {
      found.push_back(line.substr(begin, line.find(' ', begin) - begin));
    }
  }
  return found;
}

TEST_P(EveryCommandTest, ItsHelpNamesItsOptionsAndNoOthers) {
  const Entries before = folder_.entries();
  const Outcome outcome = folder_.run(command().name + " --help");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  std::vector<std::string> expected = command().options;
  expected.insert(expected.begin(), "--help");
  EXPECT_EQ(options_in(outcome.out), expected);
  EXPECT_EQ(outcome.out.find("scene SCENE.toml") != std::string::npos, !command().scene.empty());
  EXPECT_EQ(folder_.entries(), before);
}

TEST_P(EveryCommandTest, AnUnknownOptionIsNamedWithTheKnownOnes) {
  std::string allowed = "--help";
  for (const std::string& option : command().options) {
    allowed += ", " + option;
  }
  expect_usage_error(words(command()) + " --zzzzzz",
                     "--zzzzzz is no option of " + command().name + "; allowed: " + allowed);
}

TEST_P(EveryCommandTest, AnArgumentTooManyIsNamed) {
  expect_usage_error(words(command()) + " more.toml",
                     "more.toml is one argument too many for " + command().name);
}

INSTANTIATE_TEST_SUITE_P(Commands, EveryCommandTest, testing::ValuesIn(command_table), test_name);

class SceneCommandTest : public CommandTest {};

TEST_P(SceneCommandTest, RequiresItsScene) {
  expect_usage_error(words_with_scene(command(), ""), "scene is required");
}

TEST_P(SceneCommandTest, NamesASceneThatIsMissing) {
  expect_refused(words_with_scene(command(), "nowhere.toml"), 2,
                 "nowhere.toml:1:1: scene: No such file or directory; allowed: a readable TOML "
                 "file\n");
}

TEST_P(SceneCommandTest, ReadsStandardInputAndPlacesErrorsThere) {
  folder_.write("bad.toml", "[plant]\nmass_kg = -1\n");
  expect_refused(words_with_scene(command(), "-") + " <bad.toml", 2,
                 "<stdin>:2:11: plant.mass_kg: -1 is out of range; allowed: 1e-12 to 1e+06 kg\n");
}

TEST_P(SceneCommandTest, TakesOverrides) {
  expect_refused(words_with_scene(command(), "-") +
                     " --set plant.damping_N_s_per_m=0 --set plant.mass_kg=-1 <open.toml",
                 2, "--set:2:1: plant.mass_kg: -1 is out of range; allowed: 1e-12 to 1e+06 kg\n");
}

INSTANTIATE_TEST_SUITE_P(Commands, SceneCommandTest,
                         testing::ValuesIn(commands_that([](auto& c) { return !c.scene.empty(); })),
                         test_name);

class ClosedLoopCommandTest : public CommandTest {};

TEST_P(ClosedLoopCommandTest, SaysWhereASceneHasNoController) {
  const Entries before = folder_.entries();
  const Outcome outcome = folder_.run(words_with_scene(command(), "open.toml"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.find("open.toml:1:1: controller: missing"), 0U) << outcome.err;
  EXPECT_EQ(folder_.entries(), before);
}

INSTANTIATE_TEST_SUITE_P(Commands, ClosedLoopCommandTest,
                         testing::ValuesIn(commands_that([](auto& c) {
                           return !c.scene.empty() && c.scene != "open.toml" && runs_here(c);
                         })),
                         test_name);

class OutOptionTest : public CommandTest {};

TEST_P(OutOptionTest, NeedsAFolder) {
  expect_usage_error(words(command()) + " --out", "--out: 1 required DIR missing");
  expect_usage_error(words(command()) + " --out ''", "--out: is empty; allowed: a folder");
}

INSTANTIATE_TEST_SUITE_P(Commands, OutOptionTest, testing::ValuesIn(commands_that([](auto& c) {
                           return !c.folder.empty();
                         })),
                         test_name);

/// Whatever stops the writing is found before the computation, even of one that takes minutes.
class WritingCommandTest : public CommandTest {
 protected:
  void expect_not_writable(const std::string& out, const std::string& error) const {
    expect_refused(words(command()) + " --out " + out, 1, error + "\n");
  }
  std::string path() const { return folder_.path().string(); }
};

TEST_P(WritingCommandTest, RefusesAFileInTheWay) {
  folder_.write("taken", "");
  expect_not_writable("taken", path() + "/taken: is a file, not a folder");
}

TEST_P(WritingCommandTest, RefusesAFileAmongTheParents) {
  folder_.write("taken", "");
  expect_not_writable("taken/deep/results", path() + "/taken: is a file, not a folder");
}

TEST_P(WritingCommandTest, RefusesALinkToNothing) {
  fs::create_symlink("nowhere", folder_.path() / "link");
  expect_not_writable("link", path() + "/link: is a symbolic link to nothing");
}

TEST_P(WritingCommandTest, RefusesAFolderThatNobodyMayWriteTo) {
  expect_not_writable("/proc/results",
                      "/proc/results: cannot be written: No such file or "
                      "directory");
}

TEST_P(WritingCommandTest, KeepsAFileOfSomebodyElse) {
  ASSERT_FALSE(command().others.empty());
  for (const std::string& file : command().others) {
    const SceneFolder folder;
    folder.write(file, "mine");
    const Entries before = folder.entries();
    const Outcome outcome = folder.run(words(command()) + " --out .");
    // A journal that is not the program's is an error of usage.
    EXPECT_EQ(outcome.exit_code, file.find(".journal") != std::string::npos ? 2 : 1) << file;
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("; allowed: "), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder.read(file), "mine");
    EXPECT_EQ(folder.entries(), before);
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, WritingCommandTest, testing::ValuesIn(commands_that([](auto& c) {
                           return !c.folder.empty() && runs_here(c);
                         })),
                         test_name);

/// Commands that a test can run to the end.
class QuickCommandTest : public CommandTest {
 protected:
  /// What is in the folder once the command has written there.
  Entries entries_with(const std::string& out) const {
    Entries all = folder_.entries();
    for (fs::path parent = out; !parent.empty(); parent = parent.parent_path()) {
      all.push_back(parent.string());
    }
    all.push_back(out + "/.sonoglide");
    for (const std::string& file : command().files) {
      all.push_back(out + "/" + file);
    }
    std::sort(all.begin(), all.end());
    return all;
  }
};

TEST_P(QuickCommandTest, WritesItsFilesAndSaysWhere) {
  const Entries expected = entries_with(command().folder);
  const Outcome outcome = folder_.run(words(command()));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "no progress bar on a pipe";
  EXPECT_NE(outcome.out.find(command().folder + "/"), std::string::npos) << outcome.out;
  EXPECT_EQ(folder_.entries(), expected);
}

/// To a folder with a file of somebody else, and once more; no place for temporary files is needed.
TEST_P(QuickCommandTest, WritesWhereItIsToldAndAgainAndIsQuiet) {
  Entries expected = entries_with("a/b");
  expected.emplace_back("a/b/other.txt");
  std::sort(expected.begin(), expected.end());
  fs::create_directories(folder_.path() / "a" / "b");
  folder_.write("a/b/other.txt", "mine");
  for (const char* place : {"", "TMPDIR=/nowhere "}) {
    const Outcome outcome = folder_.run_program("env", place + shell_word(SONOGLIDE_PROGRAM) + " " +
                                                           words(command()) + " --out a/b --quiet");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
    EXPECT_EQ(folder_.entries(), expected);
  }
  EXPECT_EQ(folder_.read("a/b/other.txt"), "mine");
}

INSTANTIATE_TEST_SUITE_P(Commands, QuickCommandTest,
                         testing::ValuesIn(commands_that([](auto& c) { return !c.files.empty(); })),
                         test_name);

}  // namespace
}  // namespace sonoglide::acceptance::every_command_test
