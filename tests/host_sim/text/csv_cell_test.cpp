#include "host_sim/text/csv_cell.hpp"

#include <gtest/gtest.h>

namespace sonoglide::text {
namespace {

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
}  // namespace sonoglide::text
