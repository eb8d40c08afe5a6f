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
  bool ramped;
};

TEST(RecommendedMeansTest, AreTheFirstRowOfTheTableThatHolds) {
  const std::vector<Row> rows = {{0.001, true, ModeKind::slowest, false, true, false},
                                 {0.0053, true, ModeKind::slowest, false, true, false},
                                 {0.0055, true, ModeKind::slow, true, true, false},
                                 {0.089, true, ModeKind::slow, true, true, false},
                                 {0.091, true, ModeKind::other, true, false, false},
                                 {0.479, true, ModeKind::other, true, false, false},
                                 {0.49, true, ModeKind::half_turn, false, false, true},
                                 {0.81, true, ModeKind::other, true, false, false},
                                 {1.09, true, ModeKind::other, true, false, false},
                                 {1.519, true, ModeKind::half_turn, false, false, true},
                                 {1.521, true, ModeKind::other, true, false, false},
                                 {1.901, true, ModeKind::multiple, false, false, true},
                                 {2.0, true, ModeKind::multiple, false, false, true},
                                 {2.101, true, ModeKind::other, true, false, false},
                                 {3.0001, true, ModeKind::multiple, false, false, true},
                                 {2.51, true, ModeKind::half_turn, false, false, true},
                                 {2.899, true, ModeKind::other, true, false, false},
                                 {3.101, true, ModeKind::fast, false, false, true},
                                 {3.5, true, ModeKind::fast, false, false, true},
                                 {3.95, true, ModeKind::multiple, false, false, true},
                                 {0.001, false, ModeKind::across, false, false, true},
                                 {0.81, false, ModeKind::across, false, false, true}};
  for (const Row& row : rows) {
    const RecommendedMeans found = recommended_means(row.mode, row.along);
    EXPECT_EQ(found.kind, row.kind) << row.mode;
    EXPECT_EQ(found.sensorless, row.sensorless) << row.mode;
    EXPECT_EQ(found.biased, row.biased) << row.mode;
    EXPECT_EQ(found.ramped, row.ramped) << row.mode;
    EXPECT_FALSE(reason(found.kind).empty());
  }
}

}  // namespace
}  // namespace sonoglide::configure::recommended_means_test
