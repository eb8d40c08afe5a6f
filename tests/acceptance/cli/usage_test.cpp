/// Words that the program does not know are named, and what is nearest to them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host_sim/process/regular_expression.hpp"
#include "scene_folder.hpp"
#include "tests/acceptance/program/odd_names.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::usage_test {
namespace {

bool is_command(const std::string& word) {
  return std::any_of(command_table.begin(), command_table.end(),
                     [&](const Command& command) { return command.name == word; });
}

void expect_refused(const std::string& arguments, const std::string& errors) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << arguments;
  EXPECT_EQ(outcome.out, "") << arguments;
  const std::string first = arguments.substr(0, arguments.find(' '));
  EXPECT_EQ(outcome.err,
            "sonoglide: " + errors + "\n" + usage_hint(is_command(first) ? first : std::string()));
  EXPECT_TRUE(folder.entries().empty());
}

TEST(UsageTest, AnUnknownOptionIsNamedWithTheNearestKnownOne) {
  expect_refused("sweep a.toml --thread 3",
                 "--thread is no option of sweep; did you mean --threads?");
  expect_refused("run a.toml --quite", "--quite is no option of run; did you mean --quiet?");
  expect_refused("run a.toml --ouput=b", "--ouput is no option of run; did you mean --out?");
}

TEST(UsageTest, WithNoneNearItNamesAll) {
  expect_refused("run a.toml --jobs 3",
                 "--jobs is no option of run; allowed: --help, --set, --out, --json, --quiet");
  expect_refused("--fast", "--fast is no option of sonoglide; allowed: --help, --version");
}

TEST(UsageTest, ItComesBeforeWhatIsMissing) {
  expect_refused("sweep a.toml --jobs=3",
                 "--jobs is no option of sweep; allowed: --help, --set, --vary, --out, --threads, "
                 "--shard, --merge, --status, --slurm, --quiet");
  expect_refused("pil --bord microbit a.toml", "--bord is no option of pil; did you mean --board?");
  expect_refused("sweep a.toml b.toml --jobs 3 c.toml",
                 "b.toml is one argument too many for sweep\n"
                 "--jobs is no option of sweep; allowed: --help, --set, --vary, --out, --threads, "
                 "--shard, --merge, --status, --slurm, --quiet\n"
                 "c.toml is one argument too many for sweep");
}

TEST(UsageTest, SeveralComeInTheirOrder) {
  expect_refused("run a.toml --zzzzzz --aaaaaa b.toml",
                 "--zzzzzz is no option of run; allowed: --help, --set, --out, --json, --quiet\n"
                 "--aaaaaa is no option of run; allowed: --help, --set, --out, --json, --quiet");
}

TEST(UsageTest, AnUnknownCommandIsNamed) {
  expect_refused(
      "swep a.toml",
      "swep is no command; did you mean sweep?\n"
      "a.toml is no command; allowed: run, pil, image, connect, commission, configure, ratio, sweep, "
      "robust, paper, work-precision, stability, arithmetic, design, identify, fmu, schema, "
      "completion");
}

TEST(UsageTest, ValuesThatLookLikeOptionsAreValues) {
  const ScratchFolder folder;
  EXPECT_EQ(folder.run("ratio --velocity-ratio -0.5 --dahl-number 10").exit_code, 0);
  EXPECT_EQ(folder.run("ratio --velocity-ratio=-0.5 --dahl-number=10").exit_code, 0);
}

TEST(UsageTest, AFileThatLooksLikeAnOptionIsRecognised) {
  const ScratchFolder folder;
  folder.write("-x.toml", "");
  EXPECT_EQ(
      folder.run("run -x.toml")
          .err.find("sonoglide: -x.toml is no option of run; the file of that name is ./-x.toml\n"),
      0U);
}

TEST(UsageTest, EmptyNamesAreRefused) {
  expect_refused("connect ''", "device: is empty; allowed: a serial device");
  expect_refused("commission '' a.toml", "device: is empty; allowed: a serial device");
  expect_refused("pil a.toml --port ''", "--port: is empty; allowed: a serial device");
  expect_refused("image a.toml --board pico --out ''", "--out: is empty; allowed: a file");
  expect_refused("run a.toml --out ''", "--out: is empty; allowed: a folder");
}

TEST(UsageTest, ASceneInPlaceOfTheDeviceIsSeenBeforeAnythingIsRead) {
  const ScratchFolder folder;
  folder.write("a.toml", "");
  const Outcome outcome = folder.run("commission a.toml /dev/nowhere");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(
      outcome.err.find(
          "sonoglide: device: \"a.toml\" is a file; allowed: a serial device, and then the scene\n"),
      0U);
}

TEST(UsageTest, ValuesOutOfAListNameTheList) {
  expect_refused("paper --figure twelve",
                 "--figure: \"twelve\" is no figure; allowed: 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12");
  expect_refused("paper --figure 13",
                 "--figure: \"13\" is no figure; allowed: 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12");
}

/// Both ends of each range that an option is refused with.
TEST(UsageTest, WhatAMessageAllowsOfAnOptionIsAccepted) {
  const process::RegularExpression range(
      R"(allowed: (?:a whole number, )?(-?[0-9][0-9.e+-]*) to ([0-9][0-9.e+-]*))");
  const ScratchFolder folder;
  int fed_back = 0;
  for (const Command& command : command_table) {
    const bool measures = command.name.rfind("identify", 0) == 0;
    if (command.scene.empty() && !measures && command.name != "ratio") {
      continue;  // it would begin to compute
    }
    const std::string words = measures                ? command.name + " nowhere.csv"
                              : command.scene.empty() ? command.name + " " + command.arguments
                                                      : words_with_scene(command, "nowhere.toml");
    for (const std::string& option : command.options) {
      const auto run_with = [&](const std::string& value) {
        std::string line = words.substr(0, words.find(option));
        return folder.run(line.append(" ").append(option).append(" ").append(value));
      };
      const Outcome refused = run_with("-1e300");
      const process::Match ends = range.search(refused.err);
      if (refused.exit_code != 2 || ends.empty()) {
        continue;
      }
      for (const std::string& end : {ends[1], ends[2]}) {
        const Outcome outcome = run_with(end);
        EXPECT_EQ(outcome.err.find(option + ":"), std::string::npos) << words << end << outcome.err;
        ++fed_back;
      }
    }
  }
  EXPECT_EQ(fed_back, 24);
}

TEST(UsageTest, WordsOfTheUserReachTheTerminalPrintable) {
  for (const std::string& name : odd_names) {
    const ScratchFolder folder;
    for (const std::string command : {"", "run ", "run --", "run a --out ", "run a --set ",
                                      "pil a --board ", "sweep a --vary ", "paper --figure "}) {
      const Outcome outcome = folder.run(command + shell_word(name));
      EXPECT_NE(outcome.exit_code, 0) << command << name;
      EXPECT_TRUE(is_printable(outcome.err)) << command << outcome.err;
    }
    EXPECT_TRUE(folder.entries().empty());
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::usage_test
