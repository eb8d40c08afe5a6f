#include "host_sim/output/number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace sonoglide::output::number_test {
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

TEST(QuantityTest, HasThePrefixThatSuits) {
  EXPECT_EQ(quantity(526.34, "N"), "526.3 N");
  EXPECT_EQ(quantity(0.02672, "m/s"), "26.72 mm/s");
  EXPECT_EQ(quantity(-2e-7, "m"), "-200 nm");
  EXPECT_EQ(quantity(999.99, "W"), "1 kW");
  EXPECT_EQ(quantity(999.99, "W", 5), "999.99 W");
  EXPECT_EQ(quantity(999999.9, "Hz", 7), "999.9999 kHz");
  EXPECT_EQ(quantity(0.0, "W"), "0 W");
  EXPECT_EQ(quantity(1e-18, "W"), "0.001 fW");
  EXPECT_EQ(quantity(1e17, "Hz"), "1e+05 THz");
  EXPECT_EQ(quantity(std::numeric_limits<double>::quiet_NaN(), "N"), "-");
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

TEST(NumberTest, ZeroHasNoSign) {
  EXPECT_EQ(formatted(-1e-9, "{:+.5f}"), "0");
  EXPECT_EQ(formatted(1e-9, "{:+.5f}"), "0");
  EXPECT_EQ(formatted(0.0, "{:.5f}"), "0.00000");
  EXPECT_EQ(formatted(-1e-5, "{:+.5f}"), "-0.00001");
  EXPECT_EQ(formatted(-1e-9, "{:.1e}"), "-1.0e-09");
}

}  // namespace
}  // namespace sonoglide::output::number_test
