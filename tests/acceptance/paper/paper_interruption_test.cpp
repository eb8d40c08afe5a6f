/// `sonoglide paper`, interrupted at any moment.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "tests/acceptance/program/program.hpp"
#include "tests/acceptance/program/started_program.hpp"

namespace sonoglide::acceptance::paper_interruption_test {
namespace {

void expect_nothing_left(int signal, int wait_ms) {
  const ScratchFolder folder;
  const ScratchFolder temporary;
  StartedProgram program(folder, {"paper", "--out", "paper", "--quiet"}, temporary);
  std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
  program.send(signal);
  const int status = program.end();
  EXPECT_TRUE(WIFSIGNALED(status)) << wait_ms;
  EXPECT_EQ(WTERMSIG(status), signal);
  EXPECT_EQ(folder.entries(), std::vector<std::string>());
  EXPECT_EQ(temporary.entries(), std::vector<std::string>());
}

TEST(PaperInterruption, LeavesNothing) {
  for (const int wait_ms : {50, 300, 900, 2000}) {
    expect_nothing_left(SIGINT, wait_ms);
  }
  for (const int signal : {SIGTERM, SIGHUP}) {
    expect_nothing_left(signal, 300);
  }
}

TEST(PaperInterruption, WhatAKillLeavesGoesWithTheNextRun) {
  const ScratchFolder folder;
  const ScratchFolder temporary;
  {
    StartedProgram program(folder, {"paper", "--out", "paper", "--quiet"}, temporary);
    ASSERT_TRUE(comes_true([&] { return !temporary.entries().empty(); })) << "gnuplot's files";
    program.send(SIGKILL);
    program.end();
  }
  StartedProgram again(folder, {"paper", "--figure", "3", "--out", "paper", "--quiet"}, temporary);
  const int status = again.end();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(temporary.entries(), std::vector<std::string>());
  for (const std::string& entry : folder.entries()) {
    EXPECT_EQ(entry.find(".sonoglide-"), std::string::npos) << entry;
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::paper_interruption_test
