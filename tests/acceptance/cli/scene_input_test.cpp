/// Where a command gets its scene from: a file, standard input, options.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "short_scenes.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::scene_input_test {
namespace {

class SceneInputTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("open.toml", short_open_loop);
    folder_.write("closed.toml", short_closed_loop);
  }

  ScratchFolder folder_;
};

TEST_F(SceneInputTest, StandardInputIsTheSceneStdin) {
  EXPECT_EQ(folder_.run("run - --quiet <open.toml").exit_code, 0);
  EXPECT_NE(folder_.read("out/stdin/summary.json"), "");
  EXPECT_EQ(folder_.run("configure - --quiet <closed.toml").exit_code, 0);
  EXPECT_NE(folder_.read("out/stdin/controller_configuration.hpp").find("the scene stdin."),
            std::string::npos);
  EXPECT_EQ(folder_.run("sweep - --quiet --vary friction.coefficient=0.1,0.2 <open.toml").exit_code,
            0);
  EXPECT_NE(folder_.read("out/stdin_sweep/sweep.csv"), "");
}

TEST_F(SceneInputTest, ErrorsThatShowLaterAreOfStandardInputToo) {
  const Outcome outcome = folder_.run(
      "configure - --plant float32 --set drive.waveform=square "
      "--set solver.method=event_taylor <closed.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.find("--set:1:1: drive.waveform: "), 0U) << outcome.err;
  EXPECT_EQ(folder_.run("configure - <open.toml").err.find("<stdin>:1:1: controller: missing"), 0U);
}

TEST_F(SceneInputTest, AKeyIsRemovedToMakeRoomForAnother) {
  const Outcome outcome = folder_.run(
      "run open.toml --quiet --set sliding.velocity_m_per_s= "
      "--set 'sliding.profile=[[0,0.01],[1e-3,0.05]]'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(folder_.read("out/open/summary.json"));
  EXPECT_EQ(summary.at("scene").at("sliding").dump(), "{\"profile\":[[0.0,0.01],[0.001,0.05]]}");
}

TEST_F(SceneInputTest, JsonIsTheSummaryAndNothingElse) {
  for (const std::string scene : {"open.toml", "closed.toml"}) {
    const std::vector<std::string> before = folder_.entries();
    const Outcome outcome = folder_.run("run " + scene + " --json");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(folder_.entries(), before) << "nothing is written";
    EXPECT_EQ(folder_.run("run " + scene + " --quiet --out o").out, "");
    nlohmann::json printed = nlohmann::json::parse(outcome.out);
    nlohmann::json written = nlohmann::json::parse(folder_.read("o/summary.json"));
    printed.erase("run");  // the time that it took
    written.erase("run");
    printed.at("program").erase("command_line");
    written.at("program").erase("command_line");
    EXPECT_EQ(printed, written);
    const Outcome both = folder_.run("run " + scene + " --json --out o");
    EXPECT_EQ(both.out, folder_.read("o/summary.json"));
    std::filesystem::remove_all(folder_.path() / "o");
  }
}

TEST_F(SceneInputTest, AFailedRunPrintsNoJson) {
  const Outcome outcome = folder_.run("run open.toml --json --set plant.mass_kg=0");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace sonoglide::acceptance::scene_input_test
