/// The recorded comparisons: errors and steps are those of this build. Times are times, and the
/// fastest solver is one that the document names.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/studies/work_precision/comparison.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::work_precision::measured_test {
namespace {

constexpr const char* renew =
    "If this is meant, cmake --build --preset release --target write_work_precision_measured and "
    "commit the change.";

/// A run that took longer when it was recorded is not repeated here.
constexpr double longest_run_us = 4000.0;
/// Of an error, and below which it is rounding.
constexpr double error_band = 0.01;
constexpr double rounding = 1e-14;

peers::Problem problem(const std::string& scene) {
  const std::filesystem::path folder = SONOGLIDE_WORK_PRECISION_SCENES;
  return problem_of(
      experiment::read_file(folder / (scene + ".toml"), {SONOGLIDE_WORK_PRECISION_OVERRIDES})
          .plant);
}

/// By solver and setting.
using Rows = std::map<std::pair<std::string, std::string>, csv::Row>;

Rows recorded_rows(const std::string& scene) {
  const std::filesystem::path folder = SONOGLIDE_WORK_PRECISION_MEASURED;
  const csv::Table table = csv::read_file(folder / (scene + ".csv"));
  EXPECT_EQ(table.columns(), csv::Table(to_csv({})).columns()) << scene;
  Rows rows;
  for (const csv::Row& row : table.rows()) {
    EXPECT_TRUE(rows.emplace(std::make_pair(row.text("solver"), row.text("setting")), row).second)
        << scene << " " << row.text("solver") << " " << row.text("setting");
  }
  return rows;
}

MeasuredSetting measured(const ComparedSolver& solver, double setting, const csv::Row& row) {
  return {&solver,
          setting,
          row.number("relative_error"),
          row.number("wall_us_per_period"),
          row.number("steps_per_period"),
          row.text("status")};
}

/// A peer is built in only where its library is found.
bool is_peer(const std::string& solver) {
  return solver.rfind("odeint_", 0) == 0 || solver.rfind("cvode_", 0) == 0;
}

/// As it was recorded.
SolverComparison recorded(const std::string& scene) {
  Rows rows = recorded_rows(scene);
  SolverComparison comparison;
  for (const ComparedSolver& solver : solvers()) {
    for (const double setting : solver.settings) {
      const auto row = rows.find({solver.name, setting_text(solver.knob, setting)});
      if (row == rows.end()) {
        ADD_FAILURE() << scene << " " << solver.name << " " << setting << ": no row. " << renew;
      } else {
        comparison.rows.push_back(measured(solver, setting, row->second));
        rows.erase(row);
      }
    }
  }
  for (const auto& [name, row] : rows) {
    EXPECT_TRUE(is_peer(name.first)) << scene << ": there is no " << name.first << ". " << renew;
  }
  return comparison;
}

/// Whether another machine comes to the same, and soon.
bool is_repeatable(const MeasuredSetting& row, int periods) {
  return row.ok() ? row.wall_us_per_period * periods <= longest_run_us : row.status != "too slow";
}

/// Each row that can be repeated, as a solver of one setting.
std::vector<ComparedSolver> repeated(const std::vector<const MeasuredSetting*>& rows) {
  std::vector<ComparedSolver> chosen;
  for (const MeasuredSetting* row : rows) {
    chosen.push_back(*row->solver);
    chosen.back().settings = {row->setting};
  }
  return chosen;
}

class MeasuredTest : public testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(MeasuredTest, ErrorsAndStepsAreThoseOfThisBuild) {
  const peers::Problem scene = problem(GetParam().first);
  const SolverComparison then = recorded(GetParam().first);
  std::vector<const MeasuredSetting*> rows;
  for (const MeasuredSetting& row : then.rows) {
    if (is_repeatable(row, scene.periods)) {
      rows.push_back(&row);
    }
  }
  EXPECT_GT(rows.size(), 100U);
  const std::vector<ComparedSolver> chosen = repeated(rows);
  const SolverComparison now = compare(scene, chosen, {10.0, 0.0, 0}, {});
  ASSERT_EQ(now.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string name =
        rows[i]->solver->name + " " + setting_text(rows[i]->solver->knob, rows[i]->setting);
    EXPECT_EQ(now.rows[i].status, rows[i]->status) << name << ". " << renew;
    if (rows[i]->ok()) {
      EXPECT_NEAR(now.rows[i].error, rows[i]->error, error_band * rows[i]->error + rounding)
          << name << ". " << renew;
      EXPECT_EQ(output::csv_number(now.rows[i].steps_per_period, 6),
                output::csv_number(rows[i]->steps_per_period, 6))
          << name << ". " << renew;
    }
  }
}

TEST_P(MeasuredTest, TimesAreTimes) {
  for (const MeasuredSetting& row : recorded(GetParam().first).rows) {
    EXPECT_EQ(row.ok(), std::isfinite(row.wall_us_per_period)) << row.solver->name;
    EXPECT_FALSE(row.wall_us_per_period <= 0.0) << row.solver->name;
  }
}

TEST_P(MeasuredTest, TheFastestAtAnErrorOf1em8IsOneThatTheDocumentNames) {
  const SolverComparison then = recorded(GetParam().first);
  const std::vector<const MeasuredSetting*> ranking = cheapest(then, 1e-8);
  ASSERT_GT(ranking.size(), 1U);
  EXPECT_EQ(ranking.front()->solver->name.rfind(GetParam().second, 0), 0U)
      << ranking.front()->solver->name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, MeasuredTest,
                         testing::Values(std::make_pair("table_1_open_loop", "event_gauss"),
                                         std::make_pair("stiff_contact_open_loop", "event_"),
                                         std::make_pair("heavy_friction_open_loop", "event_")),
                         [](const auto& scene) { return scene.param.first; });

}  // namespace
}  // namespace sonoglide::work_precision::measured_test
