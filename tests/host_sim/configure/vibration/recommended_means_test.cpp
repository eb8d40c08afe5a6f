/// The rows of the table "Which controller" (firmware/control/vibration.md).
#include "host_sim/configure/vibration/recommended_means.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace sonoglide::configure::recommended_means_test {
namespace {

struct Row {
  double mode;
  bool along;
  ModeKind kind;
  bool sensorless;
  bool biased;
  int codes;  ///< of a ramp; 1 without one
  double range = 0.0;
};

TEST(RecommendedMeansTest, AreTheFirstRowOfTheTableThatHolds) {
  const std::vector<Row> rows = {{0.001, true, ModeKind::slowest, false, true, 1},
                                 {0.0053, true, ModeKind::slowest, false, true, 1},
                                 {0.0055, true, ModeKind::slow, true, true, 1},
                                 {0.089, true, ModeKind::slow, true, true, 1},
                                 {0.091, true, ModeKind::other, true, false, 1},
                                 {0.479, true, ModeKind::other, true, false, 1},
                                 {0.49, true, ModeKind::half_turn, false, false, 8},
                                 {0.81, true, ModeKind::other, true, false, 1},
                                 {1.09, true, ModeKind::other, true, false, 1},
                                 {1.519, true, ModeKind::half_turn, false, false, 8},
                                 {1.521, true, ModeKind::other, true, false, 1},
                                 {1.901, true, ModeKind::twice, false, false, 2},
                                 {2.0, true, ModeKind::twice, false, false, 2},
                                 {2.099, true, ModeKind::twice, false, false, 2},
                                 {2.101, true, ModeKind::other, true, false, 1},
                                 {3.0001, true, ModeKind::multiple, false, false, 8},
                                 {2.51, true, ModeKind::half_turn, false, false, 8},
                                 {2.899, true, ModeKind::other, true, false, 1},
                                 {3.101, true, ModeKind::fast, false, false, 8},
                                 {3.199, true, ModeKind::fast, false, false, 8},
                                 {3.2, true, ModeKind::unquiet, false, false, 8, 0.03},
                                 {3.499, true, ModeKind::unquiet, false, false, 8, 0.03},
                                 {3.5, true, ModeKind::fast, false, false, 8},
                                 {3.95, true, ModeKind::multiple, false, false, 8},
                                 {0.001, false, ModeKind::across, false, false, 8},
                                 {0.81, false, ModeKind::across, false, false, 8}};
  for (const Row& row : rows) {
    const RecommendedMeans found = recommended_means(row.mode, row.along);
    EXPECT_EQ(found.kind, row.kind) << row.mode;
    EXPECT_EQ(found.sensorless, row.sensorless) << row.mode;
    EXPECT_EQ(found.biased, row.biased) << row.mode;
    EXPECT_EQ(found.ramped(), row.codes > 1) << row.mode;
    EXPECT_EQ(found.codes_per_period, row.codes) << row.mode;
    EXPECT_EQ(found.shaping_range, row.range) << row.mode;
    EXPECT_FALSE(reason(found.kind).empty());
  }
}

}  // namespace
}  // namespace sonoglide::configure::recommended_means_test
