#include "coverage.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include "tests/common/csv/csv.hpp"

namespace sonoglide::identify::impedance {
namespace {

class CoverageTest : public testing::TestWithParam<Kind> {};

/// 40 sweeps and 8 parameters each. With 0.95 each, 31 or fewer of 40 hold the truth in one case of
/// 10000, so that one of the 184 counts does in 2 %. A sweep of which a sentence tells what its
/// intervals leave out counts as held.
TEST_P(CoverageTest, IntervalsHoldTheTruthOrASentenceTellsWhatTheyLeaveOut) {
  constexpr int sweeps = 40;
  for (const Coverage& each : coverage(GetParam(), sweeps, 7)) {
    const int right = each.covered + each.told - each.told_and_covered;
    EXPECT_GE(right, 32) << each.parameter;
  }
}

std::string text_of(const std::string& name) {
  std::ifstream file(std::string(IMPEDANCE) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The shares that the document gives for the sweeps of each kind.
TEST(RecordedCoverage, IsAsTheDocumentSays) {
  const csv::Table table(text_of("coverage.csv"), "coverage.csv");
  const std::string document = text_of("method.md");
  for (const Kind& kind : kinds) {
    std::vector<double> percent;
    double told = 0.0;
    for (const csv::Row& row : table.rows()) {
      if (row.text("kind") == kind.name) {
        EXPECT_EQ(row.number("sweeps"), recorded_sweeps) << kind.name;
        percent.push_back(100.0 * row.number("covered") / recorded_sweeps);
        told = 100.0 * row.number("told") / recorded_sweeps;
      }
    }
    ASSERT_EQ(percent.size(), 8U) << kind.name;
    std::sort(percent.begin(), percent.end());
    const std::string line = fmt::format(
        "| `{}` | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} % |", kind.name, percent.front(),
        std::accumulate(percent.begin(), percent.end(), 0.0) / 8.0, percent.back(), told);
    EXPECT_NE(document.find(line), std::string::npos) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, CoverageTest, testing::ValuesIn(kinds),
                         [](const testing::TestParamInfo<Kind>& each) {
                           return std::string(each.param.name);
                         });

}  // namespace
}  // namespace sonoglide::identify::impedance
