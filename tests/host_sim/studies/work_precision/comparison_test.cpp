#include "host_sim/studies/work_precision/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/host_sim/studies/work_precision/peers/published/published_problems.hpp"

namespace sonoglide::work_precision::comparison_test {
namespace {

constexpr Effort once{10.0, 0.0, 0};

ComparedSolver with_settings(const std::string& name, std::vector<double> settings) {
  for (const ComparedSolver& solver : solvers()) {
    if (solver.name == name) {
      return {solver.name, solver.family, solver.knob, std::move(settings), solver.make};
    }
  }
  ADD_FAILURE() << name;
  return {};
}

peers::Problem short_problem(const std::string& name) {
  peers::Problem problem = peers::published_problem(name);
  problem.periods = 10;
  return problem;
}

struct Expected {
  const char* solver;
  double setting;
  double error;  ///< an upper bound
};

void expect_errors(const peers::Problem& problem, const std::vector<Expected>& expected) {
  std::vector<ComparedSolver> chosen;
  for (const Expected& one : expected) {
    chosen.push_back(with_settings(one.solver, {one.setting}));
  }
  const SolverComparison comparison = compare(problem, chosen, once, {});
  ASSERT_EQ(comparison.rows.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(comparison.rows[i].status, status_ok) << expected[i].solver;
    EXPECT_LT(comparison.rows[i].error, expected[i].error) << expected[i].solver;
  }
}

TEST(SolversTest, EveryNameIsItsOwnAndNoListOfSettingsIsEmpty) {
  std::set<std::string> names;
  for (const ComparedSolver& solver : solvers()) {
    EXPECT_TRUE(names.insert(solver.name).second) << solver.name;
    EXPECT_GT(solver.settings.size(), 2U) << solver.name;
  }
}

TEST(SolversTest, SettingsReadAsTheyAre) {
  EXPECT_EQ(setting_text(Knob::tolerance, 3.2e-9), "tolerance 3.2e-09");
  EXPECT_EQ(setting_text(Knob::steps_per_period, 1000.0), "1000 steps per period");
}

TEST(ComparisonTest, TheTaylorSolversReachTheReferenceEverywhere) {
  for (const std::string& name : peers::published_names()) {
    expect_errors(short_problem(name), {{"event_taylor_8", 1e-10, 1e-8},
                                        {"event_taylor_12", 1e-12, 1e-11},
                                        {"event_taylor_16", 1e-12, 1e-11},
                                        {"event_taylor_20", 1e-12, 1e-11},
                                        {"event_gauss_8", 1e-8, 1e-8},
                                        {"event_gauss_12", 1e-10, 1e-10}});
  }
}

TEST(ComparisonTest, TheOtherSolversReachTheReferenceWhereTheContactIsSoft) {
  expect_errors(short_problem("table1"), {{"rk4", 1000, 1e-6},
                                          {"strang", 1e-6, 1e-5},
                                          {"rk4_event", 100, 1e-5},
                                          {"event_taylor_8_float32", 1e-6, 1e-5},
                                          {"event_taylor_12_float32", 1e-6, 1e-5},
                                          {"event_gauss_8_float32", 1e-6, 1e-5},
                                          {"strang_float32", 1e-4, 1e-3},
                                          {"rk4_float32", 320, 1e-4},
                                          {"rk4_event_float32", 100, 1e-4}});
}

TEST(ComparisonTest, DampingIsSeenByAll) {
  peers::Problem problem = short_problem("table1");
  problem.damping = 0.02;
  expect_errors(problem, {{"event_taylor_12", 1e-11, 1e-10},
                          {"event_gauss_8", 1e-8, 1e-8},
                          {"event_gauss_12", 1e-10, 1e-10},
                          {"event_taylor_8_float32", 1e-6, 1e-5},
                          {"rk4", 1000, 1e-5},
                          {"rk4_table", 1000, 1e-5}});
}

TEST(ComparisonTest, AFailedSolverKeepsItsRowAndSaysWhy) {
  const std::vector<ComparedSolver> chosen = {with_settings("rk4", {1000}),
                                              with_settings("rk4_table", {1000}),
                                              with_settings("event_taylor_12", {1e-8})};
  const SolverComparison comparison = compare(short_problem("stiff_contact"), chosen, once, {});
  ASSERT_EQ(comparison.rows.size(), 3U);
  for (const int i : {0, 1}) {
    const MeasuredSetting& row = comparison.rows[static_cast<std::size_t>(i)];
    EXPECT_EQ(row.status, "friction bound broken") << row.solver->name;
    EXPECT_TRUE(std::isnan(row.error));
    EXPECT_TRUE(std::isnan(row.wall_us_per_period));
  }
  EXPECT_TRUE(comparison.rows[2].ok());
}

TEST(ComparisonTest, ARunThatIsTooSlowIsBrokenOff) {
  const std::vector<ComparedSolver> chosen = {with_settings("rk4_naive", {100000})};
  constexpr Effort little{1e-3, 0.0, 0};
  const SolverComparison comparison = compare(short_problem("table1"), chosen, little, {});
  EXPECT_EQ(comparison.rows[0].status, "too slow");
  EXPECT_TRUE(std::isnan(comparison.rows[0].wall_us_per_period));
}

TEST(ComparisonTest, AroundZeroErrorsAreAbsolute) {
  // Without a pull the mass swings about its place, from one turning point to the next, and a stiff
  // contact holds it back one way as long as the other.
  peers::Problem problem = short_problem("stiff_contact");
  problem.sliding_velocity = 0.0;
  problem.displacement = -1.0 / (1.0 - problem.stiffness);
  const std::vector<ComparedSolver> chosen = {with_settings("event_taylor_16", {1e-13})};
  const SolverComparison comparison = compare(problem, chosen, once, {});
  EXPECT_TRUE(comparison.absolute_error);
  EXPECT_LT(comparison.rows[0].error, 1e-12);
}

TEST(ComparisonTest, ReportsItsProgressUpToTheEnd) {
  double last = 0.0;
  compare(short_problem("table1"), {with_settings("rk4", {10, 100})}, {10.0, 1.0, 3},
          [&last](double part) {
            EXPECT_GE(part, last);
            last = part;
          });
  EXPECT_DOUBLE_EQ(last, 1.0);
}

}  // namespace
}  // namespace sonoglide::work_precision::comparison_test
