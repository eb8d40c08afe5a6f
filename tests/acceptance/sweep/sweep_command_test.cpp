/// `sonoglide sweep` from outside: files, figures, threads, errors.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/acceptance/program/page_words.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/acceptance/sweep/scenes/base_scenes.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::acceptance::sweep_command_test {
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
  csv::Table table(const std::string& folder) const {
    return csv::Table(folder_.read(folder + "/sweep.csv"));
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

// Coulomb friction at a velocity ratio of 1 is undiminished; what the start leaves lowers it.
TEST_F(SweepCommandTest, SaysWhereTheStartIsInTheMeans) {
  const std::string options =
      "sweep open.toml --vary friction.law=dahl,coulomb --vary velocity_ratio=1:1:1 ";
  const auto ratio = [&] {
    return table("out/open_sweep").numbers("friction_ratio_whole_run").back();
  };
  const Outcome from_rest = folder_.run(options);
  EXPECT_LT(ratio(), 0.9);
  EXPECT_NE(from_rest.out.find("WARNING: The runs begin at a given state"), std::string::npos);
  EXPECT_NE(from_rest.out.find("21.6 % of the driven one"), std::string::npos) << from_rest.out;
  EXPECT_NE(folder_.read("out/open_sweep/report.html").find("The runs begin at a given state"),
            std::string::npos);
  const Outcome steady = folder_.run(options + "--set run.start=steady");
  EXPECT_NEAR(ratio(), 1.0, 1e-3);
  EXPECT_EQ(steady.out.find("WARNING"), std::string::npos);
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
  EXPECT_EQ(unexplained_symbols(page), Entries{});
  for (const char* part : {"Sweep of open", "Extremes", "velocity_ratio",
                           "<script type=\"application/json\">{\"title\":"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

TEST_F(SweepCommandTest, ThreeKeysHaveNoPictureAndTakeAnOldOneAway) {
  sweep("open.toml --out o --vary velocity_ratio=0.2:1:2");
  EXPECT_NE(folder_.read("o/sweep.svg"), "");
  sweep(
      "open.toml --out o --vary velocity_ratio=0.2:1:2 --vary friction.coefficient=0.1:0.2:2 "
      "--vary plant.mass_kg=0.02:0.03:2");
  EXPECT_EQ(table("o").rows().size(), 8U);
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
  const csv::Table points = table("o");
  ASSERT_EQ(points.rows().size(), 4U);
  EXPECT_EQ(points.columns(), (csv::Cells{"sliding.velocity_m_per_s", "friction.coefficient",
                                          "friction_ratio_whole_run", "friction_ratio_window",
                                          "dissipation_ratio_window", "status"}));
  for (const csv::Row& point : points.rows()) {
    const std::string velocity = point.text("sliding.velocity_m_per_s");
    const std::string coefficient = point.text("friction.coefficient");
    SCOPED_TRACE(velocity + " m/s, " + coefficient);
    const nlohmann::json single =
        summary("open.toml --set plant.mass_kg=0.03 --set sliding.velocity_m_per_s=" + velocity +
                " --set friction.coefficient=" + coefficient);
    const nlohmann::json& ratio = single.at("friction_ratio");
    EXPECT_EQ(point.number("friction_ratio_whole_run"), ratio.at("whole_run"));
    EXPECT_EQ(point.number("friction_ratio_window"), ratio.at("window"));
    EXPECT_EQ(point.number("dissipation_ratio_window"), single.at("power").at("dissipation_ratio"));
    EXPECT_EQ(point.text("status"), "ok");
  }
}

TEST_F(SweepCommandTest, ACoarserToleranceIsKept) {
  for (const double tolerance : {1e-4, 1e-8}) {
    sweep("open.toml --out o --vary sliding.velocity_m_per_s=0.01:0.06:4 --set solver.tolerance=" +
          std::string(tolerance > 1e-6 ? "1e-4" : "1e-8"));
    const csv::Table points = table("o");
    ASSERT_EQ(points.rows().size(), 4U);
    for (const csv::Row& point : points.rows()) {
      const nlohmann::json single = summary(
          "open.toml --set solver.tolerance=1e-13 "
          "--set sliding.velocity_m_per_s=" +
          point.text("sliding.velocity_m_per_s"));
      const double whole = single.at("friction_ratio").at("whole_run");
      const double dissipation = single.at("power").at("dissipation_ratio");
      EXPECT_NEAR(point.number("friction_ratio_whole_run") / whole, 1.0, tolerance);
      EXPECT_NEAR(point.number("dissipation_ratio_window") / dissipation, 1.0, tolerance);
    }
  }
}

TEST_F(SweepCommandTest, AClosedLoopReportsItsLastStep) {
  sweep("closed.toml --out c --vary sensor.seed=1:2:2 --vary sensor.adc_bits=8:12:2");
  const csv::Table points = table("c");
  ASSERT_EQ(points.rows().size(), 4U);
  for (const csv::Row& point : points.rows()) {
    const nlohmann::json step =
        summary("closed.toml --set sensor.seed=" + point.text("sensor.seed") +
                " --set sensor.adc_bits=" + point.text("sensor.adc_bits"))
            .at("control")
            .at("steps")
            .back();
    if (step.at("settling_time_s").is_null()) {
      EXPECT_EQ(point.text("settling_time_s"), "nan");
    } else {
      EXPECT_EQ(point.number("settling_time_s"), step.at("settling_time_s"));
    }
    EXPECT_EQ(point.number("steady_error"), step.at("steady_error"));
    EXPECT_EQ(point.number("ripple"), step.at("ripple"));
    EXPECT_EQ(point.text("limit"), step.at("limit"));
  }
}

TEST_F(SweepCommandTest, AFaultIsInItsRow) {
  sweep("closed.toml --out c --vary sensor.force_gain=-1,1");
  const csv::Table points = table("c");
  ASSERT_EQ(points.rows().size(), 2U);
  EXPECT_EQ(points.columns().at(8), "fault");
  EXPECT_EQ(points.rows()[0].text("fault"), "measurement_implausible");
  EXPECT_EQ(points.rows()[1].text("fault"), "none");
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
  const std::string hint = "\nsonoglide sweep --help lists the options";
  expect_refused("open.toml", "sonoglide: --vary is required" + hint);
  expect_refused("open.toml --vary velocity_ratio=0.1:1:3 --threads 0",
                 "sonoglide: --threads: \"0\"; allowed: a whole number, 1 to 1024" + hint);
}

TEST_F(SweepCommandTest, WordsAreVaried) {
  sweep("open.toml --out o --vary friction.law=dahl,coulomb --vary velocity_ratio=0.2,0.6,0.9");
  const csv::Table laws = table("o");
  ASSERT_EQ(laws.rows().size(), 6U);
  EXPECT_EQ(laws.columns().at(0), "friction.law");
  for (std::size_t i = 0; i < laws.rows().size(); ++i) {
    EXPECT_EQ(laws.rows()[i].text("friction.law"), i < 3 ? "dahl" : "coulomb");
    EXPECT_EQ(laws.rows()[i].text("status"), "ok");
  }
  EXPECT_EQ(laws.rows()[3].text("velocity_ratio"), "0.2");
  const nlohmann::json single = summary("open.toml --set sliding.velocity_m_per_s=0.05");
  sweep(
      "open.toml --out m --vary solver.method=event_taylor,event_gauss,strang "
      "--set sliding.velocity_m_per_s=0.05");
  const std::vector<double> ratios = table("m").numbers("friction_ratio_whole_run");
  ASSERT_EQ(ratios.size(), 3U);
  EXPECT_EQ(ratios[0], single.at("friction_ratio").at("whole_run"));
  EXPECT_NEAR(ratios[1], ratios[0], 1e-9);
  const std::string picture = folder_.read("m/sweep.svg");
  EXPECT_NE(picture.find(">event_gauss<"), std::string::npos);
  const std::string page = folder_.read("m/report.html");
  for (const char* part : {"listed", "event_taylor", "strang"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

TEST_F(SweepCommandTest, ArithmeticsAreVariedInClosedLoop) {
  sweep("closed.toml --out c --vary controller.arithmetic=float32,q31,q15,float64");
  const csv::Table points = table("c");
  ASSERT_EQ(points.rows().size(), 4U);
  EXPECT_EQ(points.rows()[2].text("controller.arithmetic"), "q15");
  const nlohmann::json q31 = summary("closed.toml --set controller.arithmetic=q31");
  EXPECT_EQ(points.row_of("controller.arithmetic", "q31").number("steady_error"),
            q31.at("control").at("steps").back().at("steady_error"));
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

}  // namespace
}  // namespace sonoglide::acceptance::sweep_command_test
