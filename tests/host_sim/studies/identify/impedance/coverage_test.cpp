#include "coverage.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/common/csv/csv.hpp"

namespace sonoglide::identify::impedance {
namespace {

class CoverageTest : public testing::TestWithParam<Kind> {};

/// Of 80 magnitudes nobody tells half a variance that hangs together from scatter: the README says
/// so, and the intervals are known to be too short there.
bool is_known_to_be_short(const Kind& kind) {
  return !kind.has_phase && kind.error == Error::correlated;
}

/// 40 sweeps and 8 parameters each. One parameter's count has a standard deviation of 1.4.
TEST_P(CoverageTest, IntervalsHoldTheTruth) {
  constexpr int sweeps = 40;
  const bool short_ones = is_known_to_be_short(GetParam());
  int covered = 0;
  for (const Coverage& each : coverage(GetParam(), sweeps, 7)) {
    covered += each.covered;
    EXPECT_GE(each.covered, short_ones ? 28 : 31) << each.parameter;
  }
  EXPECT_GE(covered, (short_ones ? 0.75 : 0.85) * 8 * sweeps);
}

std::string text_of(const std::string& name) {
  std::ifstream file(std::string(IMPEDANCE) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What the README tells of a thousand sweeps of each kind.
TEST(RecordedCoverage, IsAsTheReadmeSays) {
  const csv::Table table(text_of("coverage.csv"), "coverage.csv");
  const std::string readme = text_of("README.md");
  for (const Kind& kind : kinds) {
    double least = 100.0;
    double most = 0.0;
    double sum = 0.0;
    int parameters = 0;
    for (const csv::Row& row : table.rows()) {
      if (row.text("kind") == kind.name) {
        EXPECT_EQ(row.number("sweeps"), 1000.0) << kind.name;
        const double percent = row.number("covered") / 10.0;
        least = std::min(least, percent);
        most = std::max(most, percent);
        sum += percent;
        ++parameters;
      }
    }
    EXPECT_EQ(parameters, 8) << kind.name;
    const std::string line =
        fmt::format("| `{}` | {:.1f} % | {:.1f} % | {:.1f} % |", kind.name, least, sum / 8.0, most);
    EXPECT_NE(readme.find(line), std::string::npos) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, CoverageTest, testing::ValuesIn(kinds),
                         [](const testing::TestParamInfo<Kind>& each) {
                           return std::string(each.param.name);
                         });

}  // namespace
}  // namespace sonoglide::identify::impedance
