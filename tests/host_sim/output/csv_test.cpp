#include "host_sim/output/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace sonoglide::output::csv_test {
namespace {

TEST(CsvNumber, AlwaysReadsAsANumber) {
  EXPECT_EQ(csv_number(0.1, 17), "0.10000000000000001");
  EXPECT_EQ(csv_number(1234567.0, 3), "1.23e+06");
  const double undefined = std::numeric_limits<double>::quiet_NaN();
  for (const double each : {undefined, -undefined}) {
    EXPECT_EQ(csv_number(each, 17), "nan");
    EXPECT_TRUE(std::isnan(std::strtod(csv_number(each, 6).c_str(), nullptr)));
  }
  const double endless = std::numeric_limits<double>::infinity();
  EXPECT_EQ(std::strtod(csv_number(-endless, 6).c_str(), nullptr), -endless);
}

// RFC 4180, section 2, paragraphs 5 to 7.
TEST(CsvCellTest, QuotesWhatWouldEndTheCell) {
  EXPECT_EQ(csv_cell("plain text"), "plain text");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csv_cell(""), "");
}

TEST(CsvCellTest, IsOneLine) {
  EXPECT_EQ(csv_cell("a\nb\r"), "a\\x0ab\\x0d");
}

}  // namespace
}  // namespace sonoglide::output::csv_test
