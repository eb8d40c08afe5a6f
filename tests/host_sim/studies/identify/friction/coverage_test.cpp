/// 95 % intervals have the truth as often as they say.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/common/csv/csv.hpp"
#include "tests/host_sim/studies/identify/friction/synthetic/synthetic.hpp"

namespace sonoglide::identify::friction::coverage_test {
namespace {

csv::Table recorded() {
  std::ifstream stream(COVERAGE);
  return csv::Table(std::string(std::istreambuf_iterator<char>(stream), {}), "coverage.csv");
}

TEST(FrictionCoverage, OfAThousandSetsOfEachKindIsWithinItsBand) {
  const csv::Table table = recorded();
  for (const csv::Row& row : table.rows()) {
    const std::string kind = row.text("kind");
    const std::string sets = row.text("sets");
    EXPECT_EQ(sets.size(), 1000U) << kind;
    const double percent = row.number("covered_percent");
    double counted = 0.0;
    for (const char digit : sets) {
      counted += digit == '1' ? 0.1 : 0.0;
    }
    EXPECT_NEAR(percent, counted, 1e-6) << kind;
    // A data set without any misfit has wider intervals than it needs; one that always has some, of
    // which half is not seen, narrower ones.
    const bool mixed = kind.find("misfit") == std::string::npos;
    EXPECT_GE(percent, mixed ? 93.6 : 91.0) << kind << row.text("parameter");
    EXPECT_LE(percent, mixed ? 96.4 : 99.0) << kind << row.text("parameter");
  }
}

TEST(FrictionCoverage, TheFirstSetsAreAsRecorded) {
  const csv::Table table = recorded();
  for (const synthetic::Kind& kind : synthetic::kinds()) {
    constexpr unsigned sets = 5;
    for (unsigned set = 0; set < sets; ++set) {
      const std::vector<bool> has = synthetic::covered(kind, set);
      std::size_t parameter = 0;
      for (const csv::Row& row : table.rows()) {
        if (row.text("kind") == kind.name) {
          EXPECT_EQ(row.text("sets")[set] == '1', has.at(parameter++)) << kind.name << set;
        }
      }
      EXPECT_EQ(parameter, has.size()) << kind.name;
    }
  }
}

}  // namespace
}  // namespace sonoglide::identify::friction::coverage_test
