#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/acceptance/program/page_words.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/csv/csv.hpp"
#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance::work_precision_command_test {
namespace {

using Entries = std::vector<std::string>;

const std::string table_1 = table_1_open_loop + "[run]\nduration_periods = 2\n";

/// One comparison, looked at from all sides.
class WorkPrecisionTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    folder_->write("short.toml", table_1);
    outcome_ = folder_->run("work-precision short.toml --out results");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline Outcome outcome_;
};

TEST_F(WorkPrecisionTest, WritesItsThreeFiles) {
  EXPECT_EQ(outcome_.exit_code, 0) << outcome_.err;
  EXPECT_EQ(outcome_.err, "") << "no progress bar on a pipe";
  EXPECT_NE(outcome_.out.find("results/report.html"), std::string::npos);
  EXPECT_EQ(folder_->entries(),
            (Entries{"results", "results/.sonoglide", "results/report.html",
                     "results/work_precision.csv", "results/work_precision.svg", "short.toml"}));
}

TEST_F(WorkPrecisionTest, TheTableHasEverySolverAndItsSchema) {
  const csv::Table table(folder_->read("results/work_precision.csv"));
  EXPECT_EQ(table.columns(), (csv::Cells{"solver", "setting", "relative_error",
                                         "wall_us_per_period", "steps_per_period", "status"}));
  std::map<std::string, int> solved;
  for (const csv::Row& row : table.rows()) {
    const std::string& solver = row.text("solver");
    if (row.text("status") == "ok") {
      EXPECT_GE(row.number("relative_error"), 0.0) << solver;
      EXPECT_GT(row.number("wall_us_per_period"), 0.0) << solver;
      EXPECT_GT(row.number("steps_per_period"), 0.0) << solver;
      ++solved[solver];
    }
  }
  for (const char* solver :
       {"event_taylor_8", "event_taylor_12", "event_taylor_16", "event_taylor_20", "event_gauss_8",
        "event_gauss_12", "strang", "rk4", "rk4_event", "event_taylor_8_float32", "strang_float32",
        "rk4_float32", "rk4_event_float32", "rk4_table", "rk4_naive"}) {
    EXPECT_GT(solved[solver], 2) << solver;
  }
}

TEST_F(WorkPrecisionTest, ThePictureNamesItsLinesAndAxes) {
  const std::string svg = folder_->read("results/work_precision.svg");
  for (const char* text :
       {"event_taylor_12", "rk4_table", "Relative error", "Time for one carrier"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST_F(WorkPrecisionTest, ThePageHasTheRankingThePictureAndTheMachine) {
  const std::string page = folder_->read("results/report.html");
  EXPECT_EQ(unexplained_symbols(page), Entries{});
  for (const char* text : {"Cheapest setting", "Times the fastest", "Machine and compiler",
                           "<script type=\"application/json\">{\"title\":", "The paper"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
}

TEST_F(WorkPrecisionTest, WithoutAFolderTheSceneNamesIt) {
  // A name that gnuplot would take for a command.
  const std::string name = "x'; system(\"touch pwned\") #\\";
  const ScratchFolder folder;
  folder.write(name + ".toml", table_1);
  const Outcome outcome = folder.run("work-precision " + shell_word(name + ".toml") + " --quiet");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const std::string results = "out/" + name + "_work_precision";
  EXPECT_EQ(folder.entries(), (Entries{"out", results, results + "/.sonoglide",
                                       results + "/report.html", results + "/work_precision.csv",
                                       results + "/work_precision.svg", name + ".toml"}));
  EXPECT_NE(folder.read(results + "/work_precision.svg").find(">x'; system("), std::string::npos);
}

void expect_refused(const std::string& scene, const std::string& place_and_key) {
  const ScratchFolder folder;
  folder.write("scene.toml", scene);
  const Outcome outcome = folder.run("work-precision scene.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.rfind(place_and_key, 0), 0U) << outcome.err;
  EXPECT_EQ(folder.entries(), Entries{"scene.toml"});
}

std::string replaced(const std::string& text, const std::string& by) {
  std::string scene = table_1;
  return scene.replace(scene.find(text), text.size(), by);
}

TEST(WorkPrecisionUsageTest, WhatCannotBeComparedIsRefusedByName) {
  expect_refused(
      replaced("force_amplitude_N", "max_force_amplitude_N") +
          "[controller]\narithmetic = \"float64\"\ntarget_friction_ratio = [[0.0, 0.5]]\n",
      "scene.toml:15:2: controller: ");
  expect_refused(replaced("velocity_m_per_s = 0.0267", "profile = [[0.0, 0.02], [1e-3, 0.03]]"),
                 "scene.toml:9:11: sliding.profile: ");
  expect_refused(replaced("duration_periods = 2", "duration_periods = 2.5"),
                 "scene.toml:13:2: run: ");
  expect_refused(replaced("coefficient = 0.1", "coefficient = 0"),
                 "scene.toml:6:15: friction.coefficient: ");
}

}  // namespace
}  // namespace sonoglide::acceptance::work_precision_command_test
