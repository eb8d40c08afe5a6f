/// A small study, written and read back.

#include "host_sim/studies/stability/study.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "host_sim/studies/stability/trial.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::stability::study_test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t scenes = 50;

class StabilityStudyTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::string name = (fs::temp_directory_path() / "sonoglide_study_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    MapGrid grid;
    grid.contact_stiffness_N_per_m = {1e4, 1e8};
    grid.tolerance = {1e-4, 1e-8};
    grid.steps_per_period = {16.0, 256.0};
    grid.periods = 2;
    result_ = study(grid, scenes, [](double) {});
    output::write(folder_ / "out", report(result_));
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static std::string read(const std::string& name) {
    std::ifstream file(folder_ / "out" / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  static void expect_cells(const std::string& name, const csv::Cells& columns, std::size_t rows) {
    const csv::Table table = csv::read_file(folder_ / "out" / name);
    EXPECT_EQ(table.columns(), columns);
    EXPECT_EQ(table.rows().size(), rows) << name;
    for (const csv::Row& row : table.rows()) {
      for (const std::string& cell : row.cells()) {
        EXPECT_NE(cell, "") << name;
      }
    }
  }

  static inline fs::path folder_;
  static inline StabilityStudy result_;
};

TEST_F(StabilityStudyTest, WritesEveryMapCell) {
  for (const char* name : {"stability_map.csv", "stability_map_float32.csv"}) {
    expect_cells(name,
                 {"solver", "setting", "contact_stiffness_N_per_m", "verdict", "relative_error"},
                 4 * solvers().size());
  }
}

TEST_F(StabilityStudyTest, WritesOneRowForEachSolverAndPrecision) {
  expect_cells(
      "extremes.csv",
      {"solver", "precision", "setting", "scenes", "good", "silent_imbalance",
       "silent_friction_bound", "silent_not_finite", "declined_friction_bound",
       "declined_step_too_long", "declined_not_finite", "declined_too_many_steps", "unsupported",
       "residual_median", "residual_q90", "residual_q99", "residual_q999", "residual_largest"},
      2 * solvers().size());
}

TEST_F(StabilityStudyTest, WritesTheWorstScenesWithAllTheirNumbers) {
  expect_cells("extremes_worst.csv",
               {"solver",
                "precision",
                "setting",
                "verdict",
                "balance_residual",
                "largest_friction",
                "scene",
                "mass_kg",
                "stiffness_N_per_m",
                "damping_N_s_per_m",
                "initial_displacement_m",
                "initial_velocity_m_per_s",
                "law",
                "coefficient",
                "normal_force_N",
                "contact_stiffness_N_per_m",
                "initial_force_N",
                "sign_convention",
                "sliding_begin_m_per_s",
                "sliding_end_m_per_s",
                "frequency_Hz",
                "force_amplitude_N",
                "duration_s"},
               2 * 5 * solvers().size());
}

TEST_F(StabilityStudyTest, DrawsAPanelForEachSolver) {
  for (const char* name : {"stability_map.svg", "stability_map_float32.svg"}) {
    const std::string picture = read(name);
    for (const TriedSolver& solver : solvers()) {
      EXPECT_NE(picture.find(std::string(solver.name)), std::string::npos) << solver.name;
    }
  }
}

TEST_F(StabilityStudyTest, ThePageHoldsPicturesAndTable) {
  const std::string page = read("report.html");
  EXPECT_NE(page.find("<script type=\"application/json\">{\"title\":"), std::string::npos);
  EXPECT_NE(page.find("Extreme cases: 50 random scenes"), std::string::npos);
  EXPECT_NE(page.find("event_taylor_16"), std::string::npos);
}

TEST_F(StabilityStudyTest, TheTextNamesEverySolver) {
  const std::string text = study_text(result_.extremes);
  EXPECT_EQ(text.rfind("50 random scenes\n", 0), 0U);
  for (const TriedSolver& solver : solvers()) {
    EXPECT_NE(text.find(std::string(solver.name)), std::string::npos) << solver.name;
  }
}

}  // namespace
}  // namespace sonoglide::stability::study_test
