/// The sample of "How to add a command" is a command like the others.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "short_scenes.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::acceptance::sample_command_test {
namespace {

using Entries = std::vector<std::string>;

class SampleCommandTest : public testing::Test {
 protected:
  SampleCommandTest() { folder_.write("scene.toml", short_open_loop); }
  Outcome run(const std::string& arguments) const {
    return folder_.run_program(SONOGLIDE_WITH_SAMPLE, arguments);
  }

  ScratchFolder folder_;
};

TEST_F(SampleCommandTest, HelpNamesItBesideTheOthers) {
  const std::string help = run("--help").out;
  std::string others = folder_.run("--help").out;
  others.pop_back();  // the empty line behind the last command
  EXPECT_EQ(help.find(others), 0U) << "the others are as they were";
  EXPECT_NE(help.find("\n  natural-mode                Frequency of the natural mode of a scene's "
                      "plant\n"),
            std::string::npos)
      << help;
}

TEST_F(SampleCommandTest, ReadsASceneAndWritesItsResult) {
  const Outcome outcome = run("natural-mode scene.toml --set plant.mass_kg=0.04");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "table: out/scene_natural_mode/natural_mode.csv\n");
  const csv::Table table(folder_.read("out/scene_natural_mode/natural_mode.csv"));
  // sqrt(133e6 N/m / 0.04 kg) / 2π.
  EXPECT_NEAR(table.row_of("scene", "scene").number("natural_mode_Hz"), 9177.3217, 1e-3);
}

TEST_F(SampleCommandTest, FailsAsTheOthersDo) {
  const auto expect_refused = [this](const std::string& arguments, int exit_code,
                                     const std::string& error) {
    const Outcome outcome = run("natural-mode " + arguments);
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, error + "\n");
    EXPECT_EQ(folder_.entries(), Entries{"scene.toml"});
  };
  const std::string hint = "\nsonoglide natural-mode --help lists the options";
  expect_refused("", 2, "sonoglide: scene is required" + hint);
  expect_refused("scene.toml --quite", 2,
                 "sonoglide: --quite is no option of natural-mode; did you mean --quiet?" + hint);
  expect_refused("scene.toml --set plant.stiffness_N_per_m=0", 2,
                 "--set:1:1: plant.stiffness_N_per_m: a free mass has no natural mode; allowed: "
                 "above 0 N/m");
  expect_refused("scene.toml --out scene.toml", 1,
                 folder_.path().string() + "/scene.toml: is a file, not a folder");
}

}  // namespace
}  // namespace sonoglide::acceptance::sample_command_test
