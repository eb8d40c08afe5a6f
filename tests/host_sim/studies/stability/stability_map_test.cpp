/// A coarse map shows what theory says of it.

#include "host_sim/studies/stability/stability_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability::stability_map_test {
namespace {

MapGrid coarse_grid() {
  MapGrid grid;
  grid.contact_stiffness_N_per_m = {1e4, 5.6e4, 1e8, 1e11};
  grid.tolerance = {1e-4, 1e-8};
  grid.steps_per_period = {16.0, 1024.0};
  grid.periods = 3;
  return grid;
}

const StabilityMaps& coarse() {
  static const StabilityMaps maps = stability_maps(coarse_grid(), [](double) {});
  return maps;
}

const SolverMap& map_of(std::string_view solver) {
  for (const SolverMap& map : coarse().maps) {
    if (map.solver == solver && map.precision == "float64") {
      return map;
    }
  }
  throw std::out_of_range("no such map");
}

TEST(StabilityMap, EverySolverHasItsMapInBothPrecisions) {
  EXPECT_EQ(coarse().maps.size(), 2 * solvers().size());
  for (const SolverMap& map : coarse().maps) {
    EXPECT_EQ(map.cells.size(), 8U) << map.solver;
  }
}

TEST(StabilityMap, TwoOrdersAgreeOnTheReference) {
  EXPECT_LT(coarse().reference_difference, 1e-10);
}

TEST(StabilityMap, TheEventSolversAreAccurateAtAnyStiffness) {
  for (const char* solver :
       {"event_taylor_8", "event_taylor_12", "event_taylor_16", "event_gauss"}) {
    for (const MapCell& cell : map_of(solver).cells) {
      EXPECT_EQ(cell.verdict, Verdict::good) << solver << " at " << cell.contact_stiffness_N_per_m;
    }
  }
}

TEST(StabilityMap, RungeKuttaIsAccurateFarInsideItsLimitAndSaysSoFarBeyond) {
  int far_inside = 0;
  int far_beyond = 0;
  for (const MapCell& cell : map_of("rk4").cells) {
    const double limit = rk4_limit_steps_per_period(cell.contact_stiffness_N_per_m);
    if (cell.setting > 1000.0 && cell.setting > 20.0 * limit) {
      EXPECT_EQ(cell.verdict, Verdict::good) << cell.contact_stiffness_N_per_m;
      ++far_inside;
    }
    if (cell.setting < 0.05 * limit) {
      EXPECT_TRUE(cell.verdict == Verdict::declined_friction_bound ||
                  cell.verdict == Verdict::declined_not_finite)
          << cell.contact_stiffness_N_per_m;
      ++far_beyond;
    }
  }
  // Limits of 0.28, 1.6, 2.8e3 and 2.8e6 steps per period; settings of 16 and 1024.
  EXPECT_EQ(far_inside, 2);
  EXPECT_EQ(far_beyond, 3);
}

TEST(StabilityMap, AnErrorIsGivenOnlyWhereThereIsAResult) {
  for (const SolverMap& map : coarse().maps) {
    for (const MapCell& cell : map.cells) {
      const bool handed_over = cell.verdict == Verdict::good || cell.verdict == Verdict::wrong;
      EXPECT_EQ(std::isnan(cell.relative_error), !handed_over) << map.solver;
    }
  }
}

TEST(StabilityMap, TheLimitIsThePublishedOne) {
  // Table 1: v = 53.4 mm/s, Vt = 26.7 mm/s, and 0.216 of v in the natural mode: 0.0917 m/s in all.
  EXPECT_NEAR(rk4_limit_steps_per_period(0.056e6), 0.056e6 * 0.0917 / (2.785 * 0.01962 * 60e3),
              0.003);
  EXPECT_DOUBLE_EQ(rk4_limit_steps_per_period(1e9), 1e3 * rk4_limit_steps_per_period(1e6));
}

}  // namespace
}  // namespace sonoglide::stability::stability_map_test
