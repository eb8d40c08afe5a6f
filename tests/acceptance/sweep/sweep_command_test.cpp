/// `sonoglide sweep` from outside: files, figures, threads, errors.

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/acceptance/program/csv.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/acceptance/sweep/scenes/base_scenes.hpp"

namespace sonoglide::acceptance {
namespace {

using Entries = std::vector<std::string>;

class SweepCommandTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("open.toml", open_loop_scene);
    folder_.write("closed.toml", closed_loop_scene);
  }

  void sweep(const std::string& arguments) const {
    const Outcome outcome = folder_.run("sweep --quiet " + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
  }
  std::vector<Cells> rows(const std::string& folder) const {
    return csv_rows(folder_.read(folder + "/sweep.csv"));
  }
  nlohmann::json summary(const std::string& arguments) const {
    EXPECT_EQ(folder_.run("run --quiet --out single " + arguments).exit_code, 0);
    return nlohmann::json::parse(folder_.read("single/summary.json"));
  }
  void expect_refused(const std::string& arguments, const std::string& error) const {
    const Entries before = folder_.entries();
    const Outcome outcome = folder_.run("sweep " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.err, error + "\n");
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder_.entries(), before);
  }

  ScratchFolder folder_;
};

double number(const std::string& cell) {
  return std::strtod(cell.c_str(), nullptr);
}

TEST_F(SweepCommandTest, LeavesATableAPictureAndAPage) {
  const Outcome outcome = folder_.run(
      "sweep open.toml --vary velocity_ratio=0.2:1:3 "
      "--vary friction.contact_stiffness_N_per_m=1e4:1e6:3:log");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "") << "no progress bar on a pipe";
  EXPECT_EQ(outcome.out.find("9 points; 9 computed in "), 0U) << outcome.out;
  EXPECT_EQ(folder_.entries(), (Entries{"closed.toml", "open.toml", "out", "out/open_sweep",
                                        "out/open_sweep/.sonoglide", "out/open_sweep/report.html",
                                        "out/open_sweep/sweep.csv", "out/open_sweep/sweep.svg"}));
  const std::string page = folder_.read("out/open_sweep/report.html");
  for (const char* part : {"Sweep of open", "Extremes", "velocity_ratio", "data:image/svg+xml"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

TEST_F(SweepCommandTest, ThreeKeysHaveNoPictureAndTakeAnOldOneAway) {
  sweep("open.toml --out o --vary velocity_ratio=0.2:1:2");
  EXPECT_NE(folder_.read("o/sweep.svg"), "");
  sweep(
      "open.toml --out o --vary velocity_ratio=0.2:1:2 --vary friction.coefficient=0.1:0.2:2 "
      "--vary plant.mass_kg=0.02:0.03:2");
  EXPECT_EQ(rows("o").size(), 9U);
  EXPECT_EQ(folder_.read("o/sweep.svg"), "");
}

TEST_F(SweepCommandTest, OrderAndBytesDoNotDependOnTheThreads) {
  for (const char* tolerance : {"1e-4", "1e-8", "1e-10"}) {
    std::string first;
    for (const char* threads : {"1", "2", "4"}) {
      sweep(
          "open.toml --out t --vary velocity_ratio=0.05:1.2:9 "
          "--vary friction.contact_stiffness_N_per_m=1e4:1e7:70:log --set run.duration_periods=4 "
          "--set run.window_start_periods=2 --threads " +
          std::string(threads) + " --set solver.tolerance=" + tolerance);
      const std::string bytes = folder_.read("t/sweep.csv");
      first = first.empty() ? bytes : first;
      EXPECT_EQ(bytes, first) << threads << " threads, tolerance " << tolerance;
    }
  }
}

TEST_F(SweepCommandTest, EachPointIsTheRunWithItsKeysSet) {
  sweep(
      "open.toml --out o --vary sliding.velocity_m_per_s=0.05:0.01:2 "
      "--vary friction.coefficient=0.05:0.2:2 --set plant.mass_kg=0.03");
  const std::vector<Cells> table = rows("o");
  ASSERT_EQ(table.size(), 5U);
  EXPECT_EQ(table[0],
            (Cells{"sliding.velocity_m_per_s", "friction.coefficient", "friction_ratio_whole_run",
                   "friction_ratio_window", "dissipation_ratio_window", "status"}));
  for (std::size_t i = 1; i < table.size(); ++i) {
    const nlohmann::json single =
        summary("open.toml --set plant.mass_kg=0.03 --set sliding.velocity_m_per_s=" + table[i][0] +
                " --set friction.coefficient=" + table[i][1]);
    EXPECT_EQ(number(table[i][2]), single.at("friction_ratio").at("whole_run")) << i;
    EXPECT_EQ(number(table[i][3]), single.at("friction_ratio").at("window")) << i;
    EXPECT_EQ(number(table[i][4]), single.at("power").at("dissipation_ratio")) << i;
    EXPECT_EQ(table[i][5], "ok");
  }
}

TEST_F(SweepCommandTest, ACoarserToleranceIsKept) {
  for (const double tolerance : {1e-4, 1e-8}) {
    sweep("open.toml --out o --vary sliding.velocity_m_per_s=0.01:0.06:4 --set solver.tolerance=" +
          std::string(tolerance > 1e-6 ? "1e-4" : "1e-8"));
    const std::vector<Cells> table = rows("o");
    ASSERT_EQ(table.size(), 5U);
    for (std::size_t i = 1; i < table.size(); ++i) {
      const nlohmann::json single = summary(
          "open.toml --set solver.tolerance=1e-13 "
          "--set sliding.velocity_m_per_s=" +
          table[i][0]);
      const double whole = single.at("friction_ratio").at("whole_run");
      const double dissipation = single.at("power").at("dissipation_ratio");
      EXPECT_NEAR(number(table[i][1]) / whole, 1.0, tolerance);
      EXPECT_NEAR(number(table[i][3]) / dissipation, 1.0, tolerance);
    }
  }
}

TEST_F(SweepCommandTest, AClosedLoopReportsItsLastStep) {
  sweep("closed.toml --out c --vary sensor.seed=1:2:2 --vary sensor.adc_bits=8:12:2");
  const std::vector<Cells> table = rows("c");
  ASSERT_EQ(table.size(), 5U);
  for (std::size_t i = 1; i < table.size(); ++i) {
    const nlohmann::json step = summary("closed.toml --set sensor.seed=" + table[i][0] +
                                        " --set sensor.adc_bits=" + table[i][1])
                                    .at("control")
                                    .at("steps")
                                    .back();
    if (step.at("settling_time_s").is_null()) {
      EXPECT_EQ(table[i][5], "nan");
    } else {
      EXPECT_EQ(number(table[i][5]), step.at("settling_time_s"));
    }
    EXPECT_EQ(number(table[i][6]), step.at("steady_error"));
    EXPECT_EQ(number(table[i][7]), step.at("ripple"));
    EXPECT_EQ(table[i][8], step.at("limit"));
  }
}

TEST_F(SweepCommandTest, AFaultIsInItsRow) {
  sweep("closed.toml --out c --vary sensor.force_gain=-1,1");
  const std::vector<Cells> table = rows("c");
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(table[0][8], "fault");
  EXPECT_EQ(table[1][8], "measurement_implausible");
  EXPECT_EQ(table[2][8], "none");
}

TEST_F(SweepCommandTest, AFailedPointKeepsItsRow) {
  const Outcome outcome = folder_.run(
      "sweep open.toml --out o --vary friction.contact_stiffness_N_per_m=1e5:1e10:2:log "
      "--set solver.method=rk4 --set solver.step_s=1.667e-8");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1 points failed"), std::string::npos) << outcome.out;
  const std::string csv = folder_.read("o/sweep.csv");
  EXPECT_NE(csv.find("\n100000,0."), std::string::npos) << csv;
  EXPECT_NE(csv.find(",ok\n10000000000,nan,nan,nan,\"solver: at "), std::string::npos) << csv;
  EXPECT_NE(folder_.read("o/report.html").find("1 of 2 points could not be computed"),
            std::string::npos);
}

TEST_F(SweepCommandTest, BadInputIsFoundBeforeAnythingRuns) {
  expect_refused("open.toml --vary friction.coefficient=0.1:0.2",
                 "--vary:1:1: friction.coefficient: \"0.1:0.2\" is not a range; allowed: "
                 "KEY=FROM:TO:COUNT, KEY=FROM:TO:COUNT:log or KEY=A,B,...");
  expect_refused("open.toml --vary velocity_ratio=0.1:1:3 --vary friction.coefficient=99:101:3",
                 "--vary:2:1: friction.coefficient: 101 is out of range; allowed: 0 to "
                 "100 (at velocity_ratio=0.1, friction.coefficient=101)");
  expect_refused(
      "nowhere.toml --vary friction.coefficient=0.1:0.2:2",
      "nowhere.toml:1:1: scene: No such file or directory; allowed: a readable TOML file");
  const std::string hint = "\nsonoglide --help lists the commands and their options";
  expect_refused("open.toml", "sonoglide: --vary is required" + hint);
  expect_refused("open.toml --vary velocity_ratio=0.1:1:3 --threads 0",
                 "sonoglide: --threads: \"0\"; allowed: a whole number, 1 to 1024" + hint);
}

TEST_F(SweepCommandTest, WordsAreVaried) {
  sweep("open.toml --out o --vary friction.law=dahl,coulomb --vary velocity_ratio=0.2,0.6,0.9");
  const std::vector<Cells> table = rows("o");
  ASSERT_EQ(table.size(), 7U);
  EXPECT_EQ(table[0][0], "friction.law");
  for (std::size_t i = 1; i < table.size(); ++i) {
    EXPECT_EQ(table[i][0], i < 4 ? "dahl" : "coulomb");
    EXPECT_EQ(table[i].back(), "ok");
  }
  EXPECT_EQ(table[4][1], "0.2");
  const nlohmann::json single = summary("open.toml --set sliding.velocity_m_per_s=0.05");
  sweep(
      "open.toml --out m --vary solver.method=event_taylor,event_gauss,strang "
      "--set sliding.velocity_m_per_s=0.05");
  const std::vector<Cells> methods = rows("m");
  ASSERT_EQ(methods.size(), 4U);
  EXPECT_EQ(number(methods[1][1]), single.at("friction_ratio").at("whole_run"));
  EXPECT_NEAR(number(methods[2][1]), number(methods[1][1]), 1e-9);
  const std::string picture = folder_.read("m/sweep.svg");
  EXPECT_NE(picture.find(">event_gauss<"), std::string::npos);
  const std::string page = folder_.read("m/report.html");
  for (const char* part : {"listed", "event_taylor", "strang"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

TEST_F(SweepCommandTest, ArithmeticsAreVariedInClosedLoop) {
  sweep("closed.toml --out c --vary controller.arithmetic=float32,q31,q15,float64");
  const std::vector<Cells> table = rows("c");
  ASSERT_EQ(table.size(), 5U);
  EXPECT_EQ(table[3][0], "q15");
  const auto& heading = table[0];
  const auto column = static_cast<std::size_t>(
      std::find(heading.begin(), heading.end(), "steady_error") - heading.begin());
  ASSERT_LT(column, heading.size());
  EXPECT_EQ(number(table[2][column]), summary("closed.toml --set controller.arithmetic=q31")
                                          .at("control")
                                          .at("steps")
                                          .back()
                                          .at("steady_error"));
}

TEST_F(SweepCommandTest, AWordThatNoSceneHasIsRefused) {
  expect_refused("open.toml --vary friction.law=dahl,coulom",
                 "--vary:1:1: friction.law: \"coulom\" is unknown; did you mean \"coulomb\"? "
                 "allowed: \"dahl\", \"lugre\", \"iwan\", \"coulomb\", \"stribeck\", "
                 "\"transverse_coulomb\", \"normal_coulomb\", \"none\" (at friction.law=coulom)");
  expect_refused("open.toml --vary friction.law=coulomb,none",
                 "open.toml:7:29: friction.contact_stiffness_N_per_m: not used at any point of the "
                 "sweep; remove it");
}

TEST_F(SweepCommandTest, AFileInTheWayIsFoundBeforeAnythingRuns) {
  folder_.write("taken", "");
  const Outcome outcome = folder_.run("sweep open.toml --out taken --vary velocity_ratio=0.1:1:3");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, folder_.path().string() + "/taken: is a file, not a folder\n");
}

}  // namespace
}  // namespace sonoglide::acceptance
