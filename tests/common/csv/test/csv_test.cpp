#include "tests/common/csv/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace sonoglide::csv::csv_test {
namespace {

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const CsvError& error) {
    return error.what();
  }
  return "no error";
}

const char* const text =
    "name,value,note\n"
    "first,1.5,\"a, b\"\n"
    "second,nan,\"says \"\"no\"\"\"\n"
    "third,1e400x,\n";

TEST(CsvTest, FindsCellsByTheirColumns) {
  const Table table(text);
  ASSERT_EQ(table.rows().size(), 3U);
  EXPECT_EQ(table.columns(), (Cells{"name", "value", "note"}));
  EXPECT_EQ(table.rows()[0].number("value"), 1.5);
  EXPECT_EQ(table.rows()[0].text("note"), "a, b");
  EXPECT_TRUE(std::isnan(table.row_of("name", "second").number("value")));
  EXPECT_EQ(table.row_of("name", "second").text("note"), "says \"no\"");
  EXPECT_EQ(table.row_of("name", "third").text("note"), "");
  EXPECT_EQ(Table("a,b\n1,2\n3,4\n").numbers("b"), (std::vector<double>{2.0, 4.0}));
}

TEST(CsvTest, KeepsTheDigitsOfALongDouble) {
  const Table table("x\n0.1234567890123456789\n");
  EXPECT_EQ(table.rows()[0].long_number("x"), 0.1234567890123456789L);
}

TEST(CsvTest, SaysWhichFileColumnOrCellIsWrong) {
  const Table table(text, "t.csv");
  EXPECT_EQ(error_of([] { read_file("/nowhere/t.csv"); }), "/nowhere/t.csv: cannot be read");
  EXPECT_EQ(error_of([&] { table.rows()[0].text("valeu"); }), "t.csv: has no column valeu");
  EXPECT_EQ(error_of([&] { table.numbers("valeu"); }), "t.csv: has no column valeu");
  EXPECT_EQ(error_of([&] { table.numbers("value"); }),
            "t.csv:4: value: \"1e400x\" is not a number");
  EXPECT_EQ(error_of([&] { table.rows()[2].long_number("note"); }),
            "t.csv:4: note: \"\" is not a number");
  EXPECT_EQ(error_of([&] { table.row_of("name", "fourth"); }),
            "t.csv: has no row with name fourth");
  EXPECT_EQ(error_of([] { Table("a\n1\n1\n", "t.csv").row_of("a", "1"); }),
            "t.csv: has several rows with a 1");
}

TEST(CsvTest, RefusesWhatIsNoTable) {
  EXPECT_EQ(error_of([] { Table("", "t.csv"); }), "t.csv: is empty; a table has a heading");
  EXPECT_EQ(error_of([] { Table("a,a\n", "t.csv"); }), "t.csv:1: a column is there twice: a,a");
  EXPECT_EQ(error_of([] { Table("a,b\n1\n", "t.csv"); }), "t.csv:2: 1 cells, but 2 columns");
  EXPECT_EQ(error_of([] { Table("a,b\n1,\"2\n", "t.csv"); }),
            "t.csv:2: a quoted cell does not end");
  EXPECT_EQ(error_of([] { Table("a,b\n\"1\"2,3\n", "t.csv"); }),
            "t.csv:2: text after a quoted cell");
}

}  // namespace
}  // namespace sonoglide::csv::csv_test
