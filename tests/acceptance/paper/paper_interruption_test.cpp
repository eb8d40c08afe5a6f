/// `sonoglide paper`, interrupted at any moment.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/acceptance/program/program.hpp"
#include "tests/acceptance/program/started_program.hpp"

namespace sonoglide::acceptance::paper_interruption_test {
namespace {

using Duration = std::chrono::duration<double>;

/// From start to end, undisturbed.
Duration duration_of_a_run() {
  const ScratchFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(folder.run("paper --out paper --quiet").exit_code, 0);
  return std::chrono::steady_clock::now() - begin;
}

/// Nothing is left, unless the program came to its end before the signal.
/// @return whether the signal ended it
bool leaves_nothing(int signal, Duration wait) {
  const ScratchFolder folder;
  const ScratchFolder temporary;
  StartedProgram program(folder, {"paper", "--out", "paper", "--quiet"}, temporary);
  std::this_thread::sleep_for(wait);
  program.send(signal);
  const int status = program.end();
  if (WIFEXITED(status)) {
    EXPECT_EQ(WEXITSTATUS(status), 0);
    return false;
  }
  EXPECT_EQ(WTERMSIG(status), signal);
  EXPECT_EQ(folder.entries(), std::vector<std::string>()) << wait.count();
  EXPECT_EQ(temporary.entries(), std::vector<std::string>()) << wait.count();
  return true;
}

/// A run may be quicker than the one that was timed: then again, after a shorter wait.
void expect_nothing_left(int signal, Duration wait) {
  constexpr int most_tries = 8;
  int tries = 1;
  while (!leaves_nothing(signal, wait)) {
    ASSERT_LT(tries++, most_tries);
    wait *= 0.75;
  }
}

TEST(PaperInterruption, LeavesNothing) {
  const Duration whole = duration_of_a_run();
  for (const double part : {0.03, 0.2, 0.5, 0.8}) {
    expect_nothing_left(SIGINT, part * whole);
  }
  for (const int signal : {SIGTERM, SIGHUP}) {
    expect_nothing_left(signal, 0.3 * whole);
  }
}

/// Not in the folders below, which may go meanwhile.
bool holds_scratch(const std::filesystem::path& out) {
  const std::filesystem::directory_iterator entries(out);
  return std::any_of(begin(entries), end(entries), [](const auto& entry) {
    return entry.path().filename().string().find(".sonoglide-") == 0;
  });
}

/// @return whether files were staged; on a loaded machine the program may have moved them by then
bool kill_with_staged_files(const ScratchFolder& folder, const ScratchFolder& temporary) {
  StartedProgram program(folder, {"paper", "--figure", "3", "--out", "paper", "--quiet"},
                         temporary);
  const std::filesystem::path out = folder.path() / "paper";
  EXPECT_TRUE(comes_true([&] { return holds_scratch(out) || program.has_ended(); }));
  program.send(SIGKILL);
  program.end();
  return holds_scratch(out);
}

TEST(PaperInterruption, WhatAKillLeavesGoesWithTheNextRun) {
  const ScratchFolder folder;
  const ScratchFolder temporary;
  const std::filesystem::path out = folder.path() / "paper";
  std::filesystem::create_directory(out);
  constexpr int most_tries = 50;
  int tries = 1;
  while (!kill_with_staged_files(folder, temporary)) {
    ASSERT_LT(tries++, most_tries);
  }
  StartedProgram again(folder, {"paper", "--figure", "3", "--out", "paper", "--quiet"}, temporary);
  const int status = again.end();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_FALSE(holds_scratch(out));
}

}  // namespace
}  // namespace sonoglide::acceptance::paper_interruption_test
