#include "host_sim/process/run_tool.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::process::run_tool_test {
namespace {

std::string failure(const std::vector<std::string>& command) {
  try {
    run_tool(command, {});
  } catch (const ProcessError& error) {
    return error.what();
  }
  return "";
}

/// The state letter of /proc, or 0 where there is no such process.
char state_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t name_end = text.rfind(')');
  return name_end == std::string::npos ? '\0' : text[name_end + 2];
}

TEST(RunTool, ReturnsAllThatTheToolSaid) {
  EXPECT_EQ(run_tool({"sh", "-c", "echo one; echo two >&2"}, {}), "one\ntwo\n");
}

TEST(RunTool, GivesTheToolNoInput) {
  EXPECT_EQ(run_tool({"cat"}, {}), "");
}

TEST(RunTool, TakesMoreThanAPipeHolds) {
  EXPECT_EQ(run_tool({"head", "-c", "1000000", "/dev/zero"}, {}).size(), 1000000U);
}

TEST(RunTool, FailsInTheToolsOwnWords) {
  EXPECT_EQ(failure({"sh", "-c", "echo no luck >&2; exit 3"}),
            "sh failed with exit code 3:\nno luck\n");
  EXPECT_EQ(failure({"sh", "-c", "kill -9 $$"}), "sh failed with signal 9:\n");
}

TEST(RunTool, FailsWhereThereIsNoTool) {
  EXPECT_EQ(failure({"no_such_tool"}),
            "no_such_tool: cannot be started: No such file or directory");
}

TEST(RunTool, EndsATreeOfProcessesWhenItsOwnerLosesPatience) {
  // A grandchild writes its id and sleeps; the owner reads it and throws.
  const std::string file = testing::TempDir() + "sonoglide_grandchild";
  std::remove(file.c_str());
  pid_t grandchild = 0;
  const auto look = [&] {
    std::ifstream(file) >> grandchild;
    if (grandchild != 0) {
      throw std::runtime_error("enough");
    }
  };
  EXPECT_THROW(run_tool({"sh", "-c",
                         "sh -c 'echo $$ >" + file + ".new; mv " + file + ".new " + file +
                             "; exec sleep 100'; true"},
                        look),
               std::runtime_error);
  ASSERT_NE(grandchild, 0);
  // Its parent is gone too: whoever inherits it may not have looked yet.
  for (int i = 0; i < 100 && state_of(grandchild) != '\0' && state_of(grandchild) != 'Z'; ++i) {
    usleep(10000);
  }
  EXPECT_TRUE(state_of(grandchild) == '\0' || state_of(grandchild) == 'Z');
  std::remove(file.c_str());
}

TEST(RequireProgram, FindsOneInThePath) {
  EXPECT_EQ(require_program("sh", "dash").filename(), "sh");
}

TEST(RequireProgram, SaysWhatToInstall) {
  try {
    require_program("no_such_tool", "some-package");
    FAIL();
  } catch (const ProcessError& error) {
    EXPECT_STREQ(error.what(),
                 "no_such_tool: is not installed; on Debian: apt-get install some-package");
  }
}

}  // namespace
}  // namespace sonoglide::process::run_tool_test
