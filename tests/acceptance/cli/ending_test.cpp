/// Every command, ended by a signal at many moments, and where nothing more can be written.
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "scene_folder.hpp"
#include "tests/acceptance/program/started_program.hpp"

namespace sonoglide::acceptance::ending_test {
namespace {

using Entries = std::vector<std::string>;

std::vector<Command> commands_here() {
  constexpr bool has_emulators = SONOGLIDE_BOARD_TESTS != 0;
  std::vector<Command> found;
  std::copy_if(command_table.begin(), command_table.end(), std::back_inserter(found),
               [](const Command& each) {
                 return each.effort != Effort::device &&
                        (has_emulators || each.effort != Effort::emulator);
               });
  return found;
}

std::string test_name(const testing::TestParamInfo<Command>& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '-' || c == ' '; }, '_');
  return name;
}

/// Starts shell words in a folder, with a folder for what is kept from run to run.
/// @param errors  a file for what it says on standard error
pid_t start(const ScratchFolder& folder, const ScratchFolder& cache, const std::string& words,
            const std::string& errors = "/dev/null") {
  const pid_t child = fork();
  if (child == 0) {
    heed_signals();
    setenv("XDG_CACHE_HOME", cache.path().c_str(), 1);
    setenv("TMPDIR", cache.path().c_str(), 1);
    // The sanitizer's search for leaks is a process of its own, which would look like a tool.
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
    const std::string line = "exec '" SONOGLIDE_PROGRAM "' " + words + " >/dev/null 2>" + errors;
    if (chdir(folder.path().c_str()) == 0) {
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    }
    _exit(127);
  }
  return child;
}

/// Of a command that was ended nothing stays but a folder with a journal, to go on from, or all
/// that it writes, where the signal came after that.
void expect_nothing_or_all(const Command& command, const ScratchFolder& folder,
                           const Entries& before) {
  Entries after = folder.entries();
  Entries left;
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                      std::back_inserter(left));
  const std::string& out = command.folder;
  for (const std::string& file : command.files) {
    EXPECT_EQ(std::count(left.begin(), left.end(), out + "/" + file),
              std::count(left.begin(), left.end(), out + "/.sonoglide"))
        << file;
  }
  const Entries known = {"out",
                         out,
                         out + "/.sonoglide",
                         out + "/sweep.journal",
                         out + "/robust.journal",
                         "out/closed.fmu",
                         "out/.sonoglide"};
  for (const std::string& entry : left) {
    const bool file = std::any_of(command.files.begin(), command.files.end(),
                                  [&](const auto& each) { return entry == out + "/" + each; });
    EXPECT_TRUE(file || std::count(known.begin(), known.end(), entry) > 0) << entry;
  }
}

class EndingTest : public testing::TestWithParam<Command> {
 protected:
  /// Signals after so many milliseconds; returns whether the command had ended before.
  static bool end_after(int wait_ms, int signal) {
    const SceneFolder folder;
    const ScratchFolder cache;
    const Entries before = folder.entries();
    const pid_t program = start(folder, cache, words(GetParam()));
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    kill(program, signal);
    int status = 0;
    waitpid(program, &status, 0);
    // What the program has left running has become a child of this process.
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a tool lives on, after " << wait_ms << " ms";
    EXPECT_EQ(errno, ECHILD);
    if (WIFEXITED(status)) {
      EXPECT_EQ(WEXITSTATUS(status), 0);
      return true;
    }
    EXPECT_EQ(WTERMSIG(status), signal);
    SCOPED_TRACE(wait_ms);
    expect_nothing_or_all(GetParam(), folder, before);
    for (const std::string& entry : cache.entries()) {
      EXPECT_EQ(entry.find(".sonoglide-"), std::string::npos) << entry;
    }
    return false;
  }
};

TEST_P(EndingTest, ASignalAtAnyMomentLeavesNothing) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  int number = 0;
  for (const int wait_ms : {4, 8, 12, 16, 20, 25, 30, 40, 60, 90, 150, 400}) {
    if (end_after(wait_ms, ++number % 2 == 0 ? SIGINT : SIGTERM)) {
      break;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, EndingTest, testing::ValuesIn(commands_here()), test_name);

class FullDiskTest : public testing::TestWithParam<Command> {};

TEST_P(FullDiskTest, NothingIsPublishedByHalves) {
  const SceneFolder folder;
  const Entries before = folder.entries();
  // Files without a byte; the messages go through pipes.
  const Outcome outcome =
      folder.run_program("sh", "-c " + shell_word("(ulimit -f 0; exec '" SONOGLIDE_PROGRAM "' " +
                                                  words(GetParam()) + " 2>&1; echo >&2) | cat"));
  EXPECT_NE(outcome.out.find(": File too large"), std::string::npos) << outcome.out;
  expect_nothing_or_all(GetParam(), folder, before);
  EXPECT_EQ(folder.read(GetParam().folder + "/.sonoglide"), "");
}

INSTANTIATE_TEST_SUITE_P(Commands, FullDiskTest, testing::ValuesIn([] {
                           std::vector<Command> found;
                           std::copy_if(command_table.begin(), command_table.end(),
                                        std::back_inserter(found),
                                        [](const Command& each) { return !each.files.empty(); });
                           return found;
                         }()),
                         test_name);

/// What runs a scene once, or many times.
class LongWorkTest : public testing::TestWithParam<Command> {};

TEST_P(LongWorkTest, IsToldBeforeItBegins) {
  const SceneFolder folder;
  const ScratchFolder cache;
  folder.write("long.toml",
               (GetParam().name == "robust" ? uncertain_closed_loop : short_open_loop));
  const pid_t program =
      start(folder, cache,
            words_with_scene(GetParam(), "long.toml") + " --set run.duration_periods=1e9", "told");
  const bool told = comes_true([&] {
    return folder.read("told").find(" steps are expected, minutes of work") != std::string::npos;
  });
  kill(program, SIGTERM);
  waitpid(program, nullptr, 0);
  EXPECT_TRUE(told) << folder.read("told");
}

INSTANTIATE_TEST_SUITE_P(Commands, LongWorkTest, testing::ValuesIn([] {
                           std::vector<Command> found;
                           std::copy_if(command_table.begin(), command_table.end(),
                                        std::back_inserter(found), [](const Command& each) {
                                          return each.name == "run" || each.name == "sweep" ||
                                                 each.name == "robust";
                                        });
                           return found;
                         }()),
                         test_name);

/// As a node of a cluster starts them; two of each write to one folder.
TEST(CrowdTest, TwoHundredProgramsAtOnceAllSucceed) {
  const SceneFolder folder;
  const ScratchFolder cache;
  constexpr int programs = 200;
  std::array<pid_t, programs> running{};
  for (int i = 0; i < programs; ++i) {
    running.at(static_cast<std::size_t>(i)) =
        start(folder, cache, "configure closed.toml --quiet --out o" + std::to_string(i / 2));
  }
  int failed = 0;
  for (const pid_t each : running) {
    int status = 0;
    waitpid(each, &status, 0);
    failed += status == 0 ? 0 : 1;
  }
  EXPECT_EQ(failed, 0);
  for (const std::string& entry : folder.entries()) {
    EXPECT_EQ(entry.find(".sonoglide-"), std::string::npos) << entry;
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::ending_test
