/// A sweep that is ended while it writes what it has computed.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/acceptance/program/program.hpp"
#include "tests/acceptance/program/started_program.hpp"
#include "tests/acceptance/sweep/scenes/base_scenes.hpp"

namespace sonoglide::acceptance::last_stage_test {
namespace {

class LastStageTest : public testing::Test {
 protected:
  void SetUp() override { folder_.write("scene.toml", open_loop_scene); }

  std::vector<std::string> words() const {
    return {"sweep",  "scene.toml",
            "--vary", "friction.coefficient=0.1:0.2:200",
            "--vary", "friction.contact_stiffness_N_per_m=1e4:1e5:200",
            "--set",  "solver.tolerance=1e-4",
            "--out",  "o",
            "--quiet"};
  }
  /// Until gnuplot draws; then it says so, and takes a while.
  LastStageTest() {
    const std::string program = (tools_.path() / "gnuplot").string();
    tools_.write("gnuplot", "#!/bin/sh\ntouch '" + (tools_.path() / "draws").string() +
                                "'\nsleep 0.5\nPATH='" + path_ + "' exec gnuplot \"$@\"\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    setenv("PATH", (tools_.path().string() + ":" + path_).c_str(), 1);
  }
  ~LastStageTest() override { setenv("PATH", path_.c_str(), 1); }
  void wait_for_the_last_stage() const {
    ASSERT_TRUE(comes_true([this] { return tools_.entries().size() == 2; }));
  }
  static bool any_scratch(const ScratchFolder& folder) {
    const std::vector<std::string> entries = folder.entries();
    return std::any_of(entries.begin(), entries.end(), [](const std::string& entry) {
      return entry.find(".sonoglide-") != std::string::npos;
    });
  }

  ScratchFolder folder_;
  ScratchFolder temporary_;
  ScratchFolder tools_;
  std::string path_ = std::getenv("PATH");
};

TEST_F(LastStageTest, KilledItLeavesNothingForTheNextRunToLeave) {
  {
    StartedProgram program(folder_, words(), temporary_);
    wait_for_the_last_stage();
    program.send(SIGKILL);
    program.end();
  }
  StartedProgram again(folder_, words(), temporary_);
  const int status = again.end();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_FALSE(any_scratch(folder_));
  EXPECT_FALSE(any_scratch(temporary_));
  EXPECT_EQ(folder_.entries(),
            (std::vector<std::string>{"o", "o/.sonoglide", "o/report.html", "o/sweep.csv",
                                      "o/sweep.svg", "scene.toml"}));
}

TEST_F(LastStageTest, InterruptedItLeavesItsJournalAndGoesOnFromThere) {
  StartedProgram program(folder_, words(), temporary_);
  wait_for_the_last_stage();
  program.send(SIGINT);
  const int status = program.end();
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
  EXPECT_FALSE(any_scratch(folder_));
  EXPECT_FALSE(any_scratch(temporary_));
  EXPECT_EQ(folder_.entries(), (std::vector<std::string>{"o", "o/sweep.journal", "scene.toml"}));
  StartedProgram again(folder_, words(), temporary_);
  const int end = again.end();
  EXPECT_TRUE(WIFEXITED(end) && WEXITSTATUS(end) == 0);
  EXPECT_EQ(folder_.entries(),
            (std::vector<std::string>{"o", "o/.sonoglide", "o/report.html", "o/sweep.csv",
                                      "o/sweep.svg", "scene.toml"}));
}

}  // namespace
}  // namespace sonoglide::acceptance::last_stage_test
