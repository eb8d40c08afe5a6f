/// Files that somebody else has put where an output goes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "short_scenes.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance {
namespace {

struct Command {
  const char* arguments;
  const char* file;  ///< that it would write or remove
};

const std::vector<Command> commands = {
    {"run open.toml --out .", "trace.csv"},  // not written: it would be removed
    {"run open.toml --out .", "summary.json"},
    {"run open.toml --out . --json", "report.html"},
    {"configure closed.toml --out .", "controller_configuration.hpp"},
    {"configure closed.toml --out .", "plant_configuration.hpp"},
    {"sweep open.toml --out . --vary velocity_ratio=0.1:1:3", "sweep.csv"},
    {"sweep open.toml --out . --vary velocity_ratio=0.1:0.1:1", "sweep.svg"},
    {"sweep open.toml --out . --vary velocity_ratio=0.1:1:3", "sweep.journal"},
    {"paper --out . --figure 3", "figure_03.csv"},
    {"paper --out .", "balance.csv"},
    {"work-precision open.toml --out .", "work_precision.svg"},
    {"stability --out .", "extremes.csv"},
    {"design closed.toml --out .", "design.json"},
};

TEST(ForeignFileTest, IsKeptByEveryCommand) {
  for (const Command& command : commands) {
    const ScratchFolder folder;
    folder.write("open.toml", short_open_loop);
    folder.write("closed.toml", short_closed_loop);
    folder.write(command.file, "mine");
    const std::vector<std::string> before = folder.entries();
    const Outcome outcome = folder.run(command.arguments);
    EXPECT_TRUE(outcome.exit_code == 1 || outcome.exit_code == 2) << command.arguments;
    EXPECT_NE(outcome.err.find(command.file), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("; allowed: "), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder.read(command.file), "mine") << command.arguments;
    EXPECT_EQ(folder.entries(), before) << command.arguments;
  }
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
}  // namespace sonoglide::acceptance
