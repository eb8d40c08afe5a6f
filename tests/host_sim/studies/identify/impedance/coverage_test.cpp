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

/// Kinds of which the README says that the intervals are too short: of 80 magnitudes nobody tells half
/// a variance that hangs together from scatter, nor a steady drift or a small inductance in series.
bool is_known_to_be_short(const Kind& kind) {
  return kind.trait == Trait::drift || kind.trait == Trait::lead ||
         (!kind.has_phase && kind.error == Error::correlated);
}

/// 12 sweeps and 8 parameters each, which are not independent of each other.
TEST_P(CoverageTest, IntervalsHoldTheTruth) {
  constexpr int sweeps = 12;
  int covered = 0;
  for (const Coverage& each : coverage(GetParam(), sweeps, 7)) {
    covered += each.covered;
  }
  EXPECT_GE(covered, (is_known_to_be_short(GetParam()) ? 0.3 : 0.8) * 8 * sweeps);
}

std::string text_of(const std::string& name) {
  std::ifstream file(std::string(IMPEDANCE) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What the README tells of the sweeps of each kind.
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
        EXPECT_EQ(row.number("sweeps"), recorded_sweeps) << kind.name;
        const double percent = 100.0 * row.number("covered") / recorded_sweeps;
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
