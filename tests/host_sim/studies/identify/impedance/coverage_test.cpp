#include "coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sonoglide::identify::impedance {
namespace {

class CoverageTest : public testing::TestWithParam<Kind> {};

/// 40 sweeps and 8 parameters each. Their mean has a standard deviation of 0.95 · 0.05/40 under the
/// root, about 3.5 %, even where all eight were one number.
TEST_P(CoverageTest, IntervalsHoldTheTruth) {
  constexpr int sweeps = 40;
  int covered = 0;
  for (const Coverage& each : coverage(GetParam(), sweeps, 7)) {
    covered += each.covered;
    EXPECT_GE(each.covered, 31) << each.parameter;
  }
  EXPECT_GE(covered, static_cast<int>(0.85 * 8 * sweeps));
}

INSTANTIATE_TEST_SUITE_P(Kinds, CoverageTest, testing::ValuesIn(kinds),
                         [](const testing::TestParamInfo<Kind>& each) {
                           return std::string(each.param.name);
                         });

}  // namespace
}  // namespace sonoglide::identify::impedance
