#include "host_sim/process/child_process.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::process::run_tool_test {
namespace {

std::string failure(const std::vector<std::string>& command) {
  try {
    run_tool(command);
  } catch (const ProcessError& error) {
    return error.what();
  }
  return "";
}

TEST(RunTool, ReturnsWhatTheToolSaidButForItsErrors) {
  EXPECT_EQ(run_tool({"sh", "-c", "echo one; echo two >&2"}), "one\n");
}

TEST(RunTool, GivesTheToolItsInput) {
  EXPECT_EQ(run_tool({"cat"}), "");
  const std::string text(1000000, 'x');
  EXPECT_EQ(run_tool({"cat"}, text), text);
}

/// What a tool does depends on none of the user's settings.
TEST(RunTool, GivesTheToolNoSettingOfTheUsers) {
  setenv("GNUTERM", "nonsense", 1);
  setenv("CXXFLAGS", "-nonsense", 1);
  const std::string variables = run_tool({"env"});
  unsetenv("GNUTERM");
  unsetenv("CXXFLAGS");
  EXPECT_EQ(variables.find("nonsense"), std::string::npos) << variables;
  EXPECT_NE(variables.find("LC_ALL=C.UTF-8\n"), std::string::npos) << variables;
  EXPECT_NE(variables.find("PATH="), std::string::npos) << variables;
}

TEST(RunTool, TakesMoreThanAPipeHolds) {
  EXPECT_EQ(run_tool({"head", "-c", "1000000", "/dev/zero"}).size(), 1000000U);
}

TEST(RunTool, FailsInTheToolsOwnWords) {
  EXPECT_EQ(failure({"sh", "-c", "echo no luck >&2; echo so far; exit 3"}),
            "sh failed with exit code 3:\nso far\nno luck\n");
  EXPECT_EQ(failure({"sh", "-c", "kill -9 $$"}), "sh failed with signal 9:\n");
}

TEST(RunTool, FailsWhereThereIsNoTool) {
  EXPECT_EQ(failure({"no_such_tool"}),
            "no_such_tool: cannot be started: No such file or directory");
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
