#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "command_table.hpp"
#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/usage.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::command_line_test {
namespace {

Outcome run(const std::string& arguments) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run(arguments);
  EXPECT_TRUE(folder.entries().empty());
  return outcome;
}

void expect_usage_error(const std::string& arguments, const std::string& error) {
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << arguments;
  EXPECT_EQ(outcome.out, "") << arguments;
  EXPECT_EQ(outcome.err,
            "sonoglide: " + error + "\n" + usage_hint(arguments.substr(0, arguments.find(' '))));
}

TEST(CommandLineTest, VersionIsPrintedAlone) {
  const Outcome outcome = run("--version");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "sonoglide " SONOGLIDE_VERSION "\n");
  EXPECT_EQ(outcome.err, "");
}

/// A command and its one line.
using NamedLine = std::pair<std::string, std::string>;

std::vector<NamedLine> listed_commands() {
  CLI::App program;
  std::vector<NamedLine> found;
  for (const auto add_command : cli::commands) {
    add_command(program);
  }
  for (const CLI::App* command : cli::commands_of(program)) {
    found.emplace_back(command->get_name(), command->get_description());
  }
  return found;
}

/// What a help says below "Subcommands:".
std::vector<NamedLine> commands_in(const std::string& help) {
  const std::string title = "\nSubcommands:\n";
  std::istringstream lines(help.substr(help.find(title) + title.size()));
  std::vector<NamedLine> found;
  NamedLine line;
  while (lines >> line.first && std::getline(lines >> std::ws, line.second)) {
    found.push_back(line);
  }
  return found;
}

TEST(CommandLineTest, HelpNamesEveryCommand) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  ASSERT_EQ(listed_commands().size() + 1, cli::commands.size()) << "only shells use complete";
  EXPECT_EQ(commands_in(outcome.out), listed_commands());
}

TEST(CommandLineTest, EveryCommandIsInTheTableOfTheTests) {
  CLI::App program;
  std::vector<std::string> listed;
  for (const auto add_command : cli::commands) {
    add_command(program);
  }
  for (const CLI::App* command : cli::commands_of(program)) {
    const auto members = cli::commands_of(*command);
    for (const CLI::App* member : members) {
      listed.push_back(command->get_name() + " " + member->get_name());
    }
    if (members.empty()) {
      listed.push_back(command->get_name());
    }
  }
  std::vector<std::string> tested;
  for (const Command& command : command_table) {
    tested.push_back(command.name);
  }
  EXPECT_EQ(tested, listed);
}

TEST(CommandLineTest, AloneItPrintsItsHelp) {
  const ScratchFolder folder;
  const Outcome alone = folder.run("");
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(alone.out, folder.run("--help").out);
  EXPECT_EQ(alone.err, "");
}

TEST(CommandLineTest, BadUsageIsRejected) {
  expect_usage_error("run scene.toml --set", "--set: 1 required TABLE.KEY=VALUE missing");
  expect_usage_error("run scene.toml --out a --out b", "--out is given twice; allowed: once");
  expect_usage_error("fmu scene.toml --out a.fmu --kind x",
                     "--kind: \"x\"; allowed: plant, controller, loop");
  expect_usage_error("fmu scene.toml --out a.fmu --kind loop --fmi 4",
                     "--fmi: \"4\"; allowed: 3, 2");
  expect_usage_error("configure scene.toml --plant x", "--plant: \"x\"; allowed: float32, q31");
}

double ratio_of(const std::string& velocity_ratio, const std::string& dahl_number) {
  const Outcome outcome =
      run("ratio --velocity-ratio " + velocity_ratio + " --dahl-number " + dahl_number);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  char* end = nullptr;
  const double ratio = std::strtod(outcome.out.c_str(), &end);
  EXPECT_STREQ(end, "\n") << "the number stands alone";
  return ratio;
}

TEST(RatioCommandTest, PrintsTheClosedForm) {
  EXPECT_NEAR(ratio_of("0.5", "0.404519756998724"), 0.674948666956629, 1e-14);
}

TEST(RatioCommandTest, AgreesWithTheTableOfPrescribedMotion) {
  EXPECT_NEAR(ratio_of("0.1", "2.023"), 0.08814, 1e-5);
  EXPECT_NEAR(ratio_of("0.5", "10"), 0.3502, 5e-5);
  EXPECT_NEAR(ratio_of("0.9", "100"), 0.7246, 5e-5);
}

TEST(RatioCommandTest, IgnoresTheSignOfTheVelocityRatio) {
  EXPECT_EQ(ratio_of("-0.5", "10"), ratio_of("0.5", "10"));
}

TEST(RatioCommandTest, IsOneWithoutReversalAndZeroWithoutSliding) {
  EXPECT_EQ(ratio_of("1", "10"), 1.0);
  EXPECT_EQ(ratio_of("1e6", "1e-3"), 1.0);
  EXPECT_NEAR(ratio_of("0", "10"), 0.0, 1e-15);
}

TEST(RatioCommandTest, HoldsItsLimitsAtTheEndsOfTheRange) {
  // Coulomb, (2/pi) asin r, and the limit of small amplitude, pi r / (2 (sqrt(1 - r²) + r asin r)).
  EXPECT_NEAR(ratio_of("0.5", "1e12"), 0.33333333333333333, 1e-5);
  EXPECT_NEAR(ratio_of("0.5", "1e-12"), 0.69637987, 1e-4);
}

TEST(RatioCommandTest, RejectsBadNumbers) {
  expect_usage_error("ratio --velocity-ratio 0.5", "--dahl-number is required");
  expect_usage_error("ratio --velocity-ratio nan --dahl-number 1",
                     "--velocity-ratio: nan is out of range; allowed: -1e+12 to 1e+12");
  expect_usage_error("ratio --velocity-ratio inf --dahl-number 1",
                     "--velocity-ratio: inf is out of range; allowed: -1e+12 to 1e+12");
  expect_usage_error("ratio --velocity-ratio 0.5 --dahl-number 0",
                     "--dahl-number: 0 is out of range; allowed: 1e-12 to 1e+12");
  expect_usage_error("ratio --velocity-ratio 0.5 --dahl-number -1",
                     "--dahl-number: -1 is out of range; allowed: 1e-12 to 1e+12");
  expect_usage_error("ratio --velocity-ratio 0.5 --dahl-number 1e400",
                     "--dahl-number: 1e400 is out of range; allowed: 1e-12 to 1e+12");
  expect_usage_error("ratio --velocity-ratio half --dahl-number 1",
                     "--velocity-ratio: \"half\" is not a number; allowed: a number, -1e+12 to "
                     "1e+12");
  expect_usage_error("ratio --velocity-ratio 0.5x --dahl-number 1",
                     "--velocity-ratio: \"0.5x\" is not a number; allowed: a number, -1e+12 to "
                     "1e+12");
}

TEST(RatioCommandTest, ReportsOutputThatCannotBeWritten) {
  const ScratchFolder folder;
  const Outcome outcome =
      folder.run("ratio --velocity-ratio 0.5 --dahl-number 1 >/dev/full 2>err #");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(folder.read("err"), "standard output: cannot be written: No space left on device\n");
}

/// A text that is longer than what the stream keeps until it is written.
TEST(SchemaCommandTest, ReportsOutputThatCannotBeWritten) {
  const ScratchFolder folder;
  EXPECT_EQ(folder.run("schema >/dev/full 2>err #").exit_code, 1);
  EXPECT_EQ(folder.read("err"), "standard output: cannot be written: No space left on device\n");
}

/// Nobody can be told, but the exit code is that of the error, and a note stops no run.
TEST(StandardErrorTest, MayBeClosedOrFull) {
  const ScratchFolder folder;
  const std::string unshaped = std::string(SONOGLIDE_SCENES) + "/target_step_unshaped.toml";
  for (const char* unwritable : {">/dev/full", ">&-"}) {
    SCOPED_TRACE(unwritable);
    const std::string nowhere = std::string(" >out 2") + unwritable + " #";
    EXPECT_EQ(folder.run("run nowhere.toml" + nowhere).exit_code, 2);
    EXPECT_EQ(folder.run("fly" + nowhere).exit_code, 2);
    EXPECT_EQ(folder.run("run --out noted " + shell_word(unshaped) + nowhere).exit_code, 0);
    EXPECT_NE(folder.read("noted/summary.json"), "");
  }
}

/// Nothing that is opened is taken for a stream that is closed: not by a tool, not for a message.
TEST(StandardStreamsTest, MayBeClosedWhereAToolIsStarted) {
  const ScratchFolder folder;
  const std::string paper = "paper --figure 3 --quiet --out ";
  EXPECT_EQ(folder.run(paper + "open").exit_code, 0);
  for (const char* closed : {" <&-", " <&- >&-", " 2>&-", " <&- 2>&-", " <&- >&- 2>&-"}) {
    EXPECT_EQ(folder
                  .run_program("sh", "-c " + shell_word("'" SONOGLIDE_PROGRAM "' " + paper +
                                                        "closed" + closed))
                  .exit_code,
              0)
        << closed;
    EXPECT_EQ(folder.read("closed/figure_03.svg"), folder.read("open/figure_03.svg")) << closed;
    EXPECT_EQ(folder.read("closed/figure_03.csv"), folder.read("open/figure_03.csv")) << closed;
  }
}

TEST(StandardInputTest, MayBeClosed) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run("run - <&-");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "<stdin>:1:1: scene: is closed or cannot be read; allowed: a readable TOML file\n");
}

}  // namespace
}  // namespace sonoglide::acceptance::command_line_test
