#include "host_sim/studies/identify/measured_table.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace sonoglide::identify {
namespace {

using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

bool any_names(const Names& /*names*/) {
  return true;
}

std::string error_of(const std::string& text) {
  const scene_file::Source source{"m.csv", text};
  try {
    const MeasuredTable table(source, find_table(source, any_names));
    for (std::size_t column = 0; column < table.names().size(); ++column) {
      table.numbers(column);
    }
  } catch (const scene_file::SceneError& error) {
    return error.what();
  }
  return "no error";
}

void expect_two_rows(const std::string& text, const Names& names) {
  const scene_file::Source source{"m.csv", text};
  const MeasuredTable table(source, find_table(source, any_names));
  EXPECT_EQ(table.names(), names) << text;
  EXPECT_EQ(table.numbers(0), (Numbers{1.0, 2.5})) << text;
  EXPECT_EQ(table.numbers(1), (Numbers{-3e3, 4.0})) << text;
}

TEST(MeasuredTable, ReadsWhatSpreadsheetsWrite) {
  expect_two_rows("a,b\n1,-3e3\n2.5,4\n", {"a", "b"});
  expect_two_rows("a,b\r\n1,-3e3\r\n2.5,+4", {"a", "b"});
  expect_two_rows("a,b\r1,-3e3\r2.5,4\r", {"a", "b"});
  expect_two_rows("a;b\n1,0;-3,0e3\n2,5;4\n", {"a", "b"});
  expect_two_rows("a\tb\n1\t-3000\n2.5\t4\n\n", {"a", "b"});
  expect_two_rows("\"a\",\"b, c\"\n\"1\",\"-3e3\"\n2.5 , 4\n", {"a", "b, c"});
  expect_two_rows("a b\n  1   -3e3\n2.5\t4\n", {"a", "b"});
}

TEST(MeasuredTable, PassesOverWhatIsNoTable) {
  expect_two_rows("!Model,X1\nPoints,2\na,b\n1,-3e3\n# note\n2.5,4\nEND\n", {"a", "b"});
  expect_two_rows("# a,b\n1,-3e3\n2.5,4\n", {"a", "b"});
  expect_two_rows("a,b\n(Hz),(ohm)\n1,-3e3\n2.5,4\n", {"a (Hz)", "b (ohm)"});
}

/// Of rows below it nothing is read, whatever ends the table.
TEST(MeasuredTable, RefusesRowsBelowTheEndOfTheTable) {
  for (const char* end : {"END", "stop"}) {
    EXPECT_EQ(error_of(std::string("a,b\n1,2\n") + end + "\n3,4\n"),
              std::string("m.csv:3:1: row: \"") + end +
                  "\" ends the table, and rows follow it; allowed: one table in a file, its rows "
                  "without a break");
  }
}

/// What JSON and a page cannot hold is escaped, and no character is cut.
TEST(MeasuredTable, ALineThatAWarningQuotesIsValidUtf8) {
  const auto quoted = [](const std::string& line) {
    const scene_file::Source source{"m.csv", "a,b\n1,2\n" + line + "\n"};
    return MeasuredTable(source, find_table(source, any_names)).warnings().at(0);
  };
  EXPECT_EQ(quoted("Operator: M\xfcller"),
            "Line 3, \"Operator: M\\xfcller\", is below the table and is not read.");
  const std::string letters(39, 'x');
  EXPECT_EQ(quoted(letters + "\u00fcy"),
            "Line 3, \"" + letters + "\", is below the table and is not read.");
  EXPECT_NE(quoted(std::string(47, '\xb5')).find("\\xb5"), std::string::npos);
}

TEST(MeasuredTable, PassesOverARowThatIsMadeAComment) {
  expect_two_rows("a,b\n1,-3e3\n#3,nan\n2.5,4\n", {"a", "b"});
}

TEST(MeasuredTable, NamesThePlaceOfWhatIsWrong) {
  EXPECT_EQ(error_of("a,b\n1,2\n3,x\n"),
            "m.csv:3:3: b: \"x\" is no number; allowed: a finite number, or # at the "
            "beginning of a line that is not read");
  EXPECT_EQ(error_of("a,b\n1,nan\n"),
            "m.csv:2:3: b: \"nan\" is no number; allowed: a finite number, or # at the "
            "beginning of a line that is not read");
  EXPECT_EQ(error_of("a,b\n1,inf\n"),
            "m.csv:2:3: b: \"inf\" is no number; allowed: a finite number, or # at the "
            "beginning of a line that is not read");
  EXPECT_EQ(error_of("a,b\n1,2\n3\n"),
            "m.csv:3:2: b: cells on this line: 1; allowed: one for each of the 2 columns");
  EXPECT_EQ(error_of("a,b\n").substr(0, 20), "m.csv:1:1: heading: ");
  EXPECT_EQ(error_of("1,2\n3,4\n").substr(0, 20), "m.csv:1:1: heading: ");
}

/// A surplus cell is a decimal comma, or a separator of thousands, that was taken for a separator.
TEST(MeasuredTable, RefusesRowsOfMoreCellsThanTheHeading) {
  EXPECT_EQ(
      error_of("a,b\n1,2\n39000,1011,2\n"),
      "m.csv:3:12: row: cells on this line: 3; allowed: one for each of the 2 columns; numbers "
      "with decimal commas need semicolons or tabs between them");
  EXPECT_EQ(error_of("a;b\n1;2\n3;4;5\n"),
            "m.csv:3:5: row: cells on this line: 3; allowed: one for each of the 2 columns");
  // Spreadsheets end rows with separators.
  EXPECT_EQ(error_of("a,b\n1,2,,\n3,4,\n"), "no error");
}

TEST(MeasuredTable, RefusesDecimalPointsBesideDecimalCommas) {
  EXPECT_EQ(
      error_of("a;b\n39,000;1011.2\n"),
      "m.csv:2:8: row: \"1011.2\" has a decimal point, and line 2 has decimal commas; allowed: "
      "one of them in a file, and nothing between thousands");
  EXPECT_EQ(error_of("a b\n1 2\n1.5 2\n1 2,5\n"),
            "m.csv:4:3: row: \"2,5\" has a decimal comma, and line 3 has decimal points; allowed: "
            "one of them in a file, and nothing between thousands");
  EXPECT_EQ(error_of("a;b\n1,5;2\n1;-2,5e-3\n"), "no error");
}

TEST(MeasuredTable, PutsUnitsOfTheLineBelowIntoBrackets) {
  const scene_file::Source source{"m.csv", "a;b;c\nkHz;;(ohm)\n1;2;3\n"};
  EXPECT_EQ(MeasuredTable(source, find_table(source, any_names)).names(),
            (Names{"a [kHz]", "b", "c (ohm)"}));
  const scene_file::Source above{"m.csv", "kHz;Ohm\na;b\n1;2\n"};
  EXPECT_EQ(MeasuredTable(above, find_table(above, any_names)).names(),
            (Names{"a [kHz]", "b [Ohm]"}));
  EXPECT_EQ(unit_in_brackets("a [kHz]"), "kHz");
  EXPECT_EQ(unit_in_brackets("a"), "");
}

TEST(MeasuredTable, ALastLineWithoutAnEndMayBeCut) {
  EXPECT_EQ(warning_of_cut({"m.csv", "a,b\n1,2\n"}), "");
  EXPECT_EQ(warning_of_cut({"m.csv", "a,b\r1,2\r"}), "");
  EXPECT_EQ(warning_of_cut({"m.csv", "a,b\n1,2\nEND"}), "");
  EXPECT_EQ(warning_of_cut({"m.csv", "a,b\n1,-86"}),
            "The last line, \"1,-86\", has no line end: if the file was cut, it is wrong.");
}

TEST(MeasuredTable, ReadsTextInUtf16) {
  const std::string text = "a,\u03a9,\u8d6b\n1,2,3\n";
  const std::u16string wide = u"a,\u03a9,\u8d6b\n1,2,3\n";
  for (const bool big : {true, false}) {
    std::string bytes = big ? "\xfe\xff" : "\xff\xfe";
    for (const char16_t each : wide) {
      const char high = static_cast<char>(each >> 8U);
      const char low = static_cast<char>(each & 0xffU);
      bytes += big ? std::string{high, low} : std::string{low, high};
    }
    const std::string file = ::testing::TempDir() + "measured_table_utf_16.csv";
    std::ofstream(file, std::ios::binary) << bytes;
    EXPECT_EQ(read_text(file).text, text);
    std::remove(file.c_str());
  }
}

TEST(MeasuredTable, RefusesAFileThatIsNoText) {
  EXPECT_THROW(read_text("/"), scene_file::SceneError);
  EXPECT_THROW(read_text("/dev/null"), scene_file::SceneError);
  EXPECT_THROW(read_text("/nowhere/at/all"), scene_file::SceneError);
}

}  // namespace
}  // namespace sonoglide::identify
