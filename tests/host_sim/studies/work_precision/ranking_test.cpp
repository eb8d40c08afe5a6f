#include "host_sim/studies/work_precision/comparison.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sonoglide::work_precision::ranking_test {
namespace {

const ComparedSolver quick{"quick", Family::blue, Knob::tolerance, {}, nullptr};
const ComparedSolver slow{"slow", Family::paper, Knob::steps_per_period, {}, nullptr};

MeasuredSetting row(const ComparedSolver& solver, double setting, double error, double wall_us) {
  MeasuredSetting row;
  row.solver = &solver;
  row.setting = setting;
  row.error = error;
  row.wall_us_per_period = wall_us;
  row.steps_per_period = 10.0;
  return row;
}

MeasuredSetting failed(const ComparedSolver& solver, double setting) {
  MeasuredSetting row;
  row.solver = &solver;
  row.setting = setting;
  row.status = "friction bound broken";
  return row;
}

SolverComparison example() {
  SolverComparison comparison;
  comparison.periods = 100;
  comparison.rows = {
      row(quick, 1e-2, 1e-9, 1.0),  // by chance
      row(quick, 1e-3, 1e-4, 1.1),   row(quick, 1e-4, 1e-5, 1.2), row(quick, 1e-5, 1e-7, 1.3),
      row(quick, 1e-6, 1e-8, 1.4),   failed(slow, 10.0),          row(slow, 100.0, 1e-5, 20.0),
      row(slow, 1000.0, 1e-7, 90.0),
  };
  return comparison;
}

TEST(RankingTest, AnErrorThatIsSmallByChanceDoesNotCount) {
  const SolverComparison comparison = example();
  const std::vector<const MeasuredSetting*> rows = cheapest(comparison, 1e-8);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]->solver, &quick);
  EXPECT_EQ(rows[0]->setting, 1e-6);
}

TEST(RankingTest, TheCheapestSolverComesFirst) {
  const SolverComparison comparison = example();
  const std::vector<const MeasuredSetting*> rows = cheapest(comparison, 1e-5);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]->setting, 1e-4);
  EXPECT_EQ(rows[1]->solver, &slow);
  EXPECT_EQ(rows[1]->setting, 100.0);
}

TEST(RankingTest, NobodyMayReachAnAccuracy) {
  EXPECT_TRUE(cheapest(example(), 1e-12).empty());
}

TEST(RankingTest, AFrontierGetsDearerAndMoreAccurate) {
  const SolverComparison comparison = example();
  const std::vector<Standing> kept = frontier(comparison, quick);
  ASSERT_GT(kept.size(), 1U);
  for (std::size_t i = 1; i < kept.size(); ++i) {
    EXPECT_GT(kept[i].row->wall_us_per_period, kept[i - 1].row->wall_us_per_period);
    EXPECT_LT(kept[i].error, kept[i - 1].error);
  }
}

TEST(CsvTest, AFailedSolverKeepsItsRow) {
  const std::string csv = to_csv(example());
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "solver,setting,relative_error,wall_us_per_period,steps_per_period,status");
  EXPECT_NE(csv.find("\nquick,tolerance 0.001,0.0001,1.1,10,ok\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\nslow,10 steps per period,nan,nan,nan,friction bound broken\n"),
            std::string::npos)
      << csv;
}

}  // namespace
}  // namespace sonoglide::work_precision::ranking_test
