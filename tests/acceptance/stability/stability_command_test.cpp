/// `sonoglide stability` from outside: its help, and a small one run to its end.

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/studies/stability/trial.hpp"
#include "tests/acceptance/program/page_words.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::acceptance::stability_command_test {
namespace {

using Entries = std::vector<std::string>;

TEST(StabilityCommand, HelpNamesItsFiles) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run("stability --help");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* part : {"report.html", "stability_map.csv", "extremes.csv"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  }
}

/// One study, looked at from all sides.
class SmallStability : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    outcome_ = folder_->run_program(SONOGLIDE_SMALL_STABILITY, "stability");
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string read(const std::string& name) {
    return folder_->read("out/stability/" + name);
  }
  /// Solver and precision of each row; a row twice is there once.
  static std::set<std::pair<std::string, std::string>> solvers_in(const csv::Table& table) {
    std::set<std::pair<std::string, std::string>> found;
    for (const csv::Row& row : table.rows()) {
      found.emplace(row.text("solver"), row.text("precision"));
    }
    return found;
  }
  static std::set<std::pair<std::string, std::string>> every_solver() {
    std::set<std::pair<std::string, std::string>> all;
    for (const stability::TriedSolver& solver : stability::solvers()) {
      for (const stability::TriedPrecision& precision : solver.precisions) {
        all.emplace(solver.name, precision.name);
      }
    }
    return all;
  }

  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline Outcome outcome_;
};

TEST_F(SmallStability, WritesItsSevenFilesAndSaysWhere) {
  EXPECT_EQ(outcome_.exit_code, 0) << outcome_.err;
  EXPECT_EQ(outcome_.err, "") << "no progress bar on a pipe";
  EXPECT_EQ(outcome_.out.rfind("50 random scenes\n", 0), 0U) << outcome_.out;
  const std::string last = "\nreport: out/stability/report.html\n";
  ASSERT_GE(outcome_.out.size(), last.size());
  EXPECT_EQ(outcome_.out.substr(outcome_.out.size() - last.size()), last);
  Entries expected{"out", "out/stability"};
  for (const char* file :
       {".sonoglide", "extremes.csv", "extremes_worst.csv", "report.html", "stability_map.csv",
        "stability_map.svg", "stability_map_float32.csv", "stability_map_float32.svg"}) {
    expected.push_back(std::string("out/stability/") + file);
  }
  EXPECT_EQ(folder_->entries(), expected);
}

TEST_F(SmallStability, CountsEverySceneOfEverySolverOnce) {
  const csv::Table table(read("extremes.csv"));
  EXPECT_EQ(table.rows().size(), every_solver().size());
  EXPECT_EQ(solvers_in(table), every_solver());
  for (const csv::Row& row : table.rows()) {
    double scenes = 0.0;
    for (const char* verdict :
         {"good", "silent_imbalance", "silent_friction_bound", "silent_not_finite",
          "declined_friction_bound", "declined_step_too_long", "declined_not_finite",
          "declined_too_many_steps", "unsupported"}) {
      scenes += row.number(verdict);
    }
    EXPECT_EQ(row.number("scenes"), 50.0);
    EXPECT_EQ(scenes, 50.0) << row.text("solver");
    EXPECT_GE(row.number("good"), 1.0) << row.text("solver");
  }
  EXPECT_EQ(solvers_in(csv::Table(read("extremes_worst.csv"))), every_solver());
}

TEST_F(SmallStability, MapsEverySettingAndStiffness) {
  for (const char* file : {"stability_map.csv", "stability_map_float32.csv"}) {
    const csv::Table table(read(file));
    std::set<csv::Cells> cells;
    for (const csv::Row& row : table.rows()) {
      cells.insert(
          {row.text("solver"), row.text("setting"), row.text("contact_stiffness_N_per_m")});
    }
    EXPECT_EQ(table.rows().size(), 4 * stability::solvers().size()) << file;
    EXPECT_EQ(cells.size(), table.rows().size()) << file << ": a cell is there twice";
  }
}

TEST_F(SmallStability, ThePageHasTheMapsAndTheTable) {
  const std::string page = read("report.html");
  EXPECT_EQ(unexplained_symbols(page), Entries{});
  for (const char* part : {"<script type=\"application/json\">{\"title\":",
                           "Extreme cases: 50 random scenes", "</html>"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  for (const stability::TriedSolver& solver : stability::solvers()) {
    EXPECT_NE(page.find(solver.name), std::string::npos) << solver.name;
  }
}

/// The example scene: its windows, its files, and a drive in each window.
TEST(SelfExcited, FindsTheWindowsOfTheExample) {
  const ScratchFolder folder;
  const Outcome found =
      folder.run("stability " SONOGLIDE_SCENES "/squeal.toml --self-excited --quiet");
  ASSERT_EQ(found.exit_code, 0) << found.err;
  EXPECT_EQ(found.out, "");
  const std::string out = "out/squeal_self_excited/";
  const auto json = nlohmann::json::parse(folder.read(out + "self_excited.json"));
  EXPECT_EQ(json["undriven"]["fate"], "grows");
  ASSERT_EQ(json["windows"].size(), 4U);
  EXPECT_NEAR(json["windows"][1]["to_m_per_s"], 0.147074864502479, 0.005 * 0.147);
  EXPECT_NEAR(json["windows"][2]["to_m_per_s"], 0.32857223524365475, 0.005 * 0.329);
  EXPECT_EQ(csv::Table(folder.read(out + "self_excited.csv")).rows().size(), 49U * 65U);
  EXPECT_EQ(folder.read(out + "self_excited.svg").rfind("<?xml", 0), 0U);
  EXPECT_NE(folder.read(out + "report.html").find("Floquet multiplier"), std::string::npos);
}

TEST(SelfExcited, AStrongDriveHidesNoWindowAndTheNarrowestIsTold) {
  const ScratchFolder folder;
  const Outcome found =
      folder.run("stability " SONOGLIDE_SCENES
                 "/squeal.toml --self-excited --set drive.max_force_amplitude_N=4e5");
  ASSERT_EQ(found.exit_code, 0) << found.err;
  EXPECT_NE(
      found.out.find("drive  1.848 kN to  4.129 kN, vibration 147.1 mm/s to 328.6 mm/s: it is "
                     "unstable"),
      std::string::npos)
      << found.out;
  const std::string narrowest =
      "A window narrower than 10 % of its force and than 4.167 kN may be missed, unless averaging has "
      "it too.";
  EXPECT_NE(found.out.find(narrowest), std::string::npos) << found.out;
  EXPECT_NE(folder.read("out/squeal_self_excited/report.html").find(narrowest), std::string::npos);
}

TEST(SelfExcited, RefusesWhatHasNoSteadySliding) {
  const ScratchFolder folder;
  const auto refusal = [&](const std::string& set) {
    const Outcome outcome =
        folder.run("stability " SONOGLIDE_SCENES "/squeal.toml --self-excited --set " + set);
    EXPECT_EQ(outcome.exit_code, 2) << set;
    return outcome.err;
  };
  for (const char* set : {"sliding.velocity_m_per_s=0", "plant.mass_kg=7.1e-4",
                          "drive.waveform=square", "friction.sign_convention=as_printed"}) {
    const std::string key = std::string(set).substr(0, std::string(set).find('='));
    EXPECT_NE(refusal(set).find(key), std::string::npos) << set;
  }
  EXPECT_EQ(folder.run("stability " SONOGLIDE_SCENES "/squeal.toml").exit_code, 2);
  EXPECT_EQ(folder.run("stability --self-excited").exit_code, 2);
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace sonoglide::acceptance::stability_command_test
