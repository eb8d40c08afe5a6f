#include "host_sim/process/printable.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace sonoglide::process::printable_test {
namespace {

TEST(PrintableTest, LeavesTextAsItIs) {
  for (const char* text : {"", "target_step", "it's $(a) `b` \"c\" \\ %d @e; #", "µ ζ 🛷 é"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(PrintableTest, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(printable("\x1b[31mred"), "\\x1b[31mred");
  EXPECT_EQ(printable("a\r\n\tb\x7f"), "a\\x0d\\x0a\\x09b\\x7f");
  EXPECT_EQ(printable("\u009b31m"), "\\xc2\\x9b31m") << "the C1 form of the same";
  EXPECT_EQ(printable("\u2028"), "\\xe2\\x80\\xa8");
  EXPECT_EQ(printable("a\u202eb"), "a\\xe2\\x80\\xaeb") << "turns the direction of writing";
  EXPECT_EQ(printable("a\uffff\ufffe"), "a\\xef\\xbf\\xbf\\xef\\xbf\\xbe") << "XML has neither";
}

// Unicode 15.0, table 3-7 and its text: what is not well-formed.
TEST(PrintableTest, EscapesWhatIsNotUtf8) {
  EXPECT_EQ(printable("caf\xe9"), "caf\\xe9");
  EXPECT_EQ(printable("\x80"), "\\x80");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "overlong";
  EXPECT_EQ(printable("\xe0\x80\xaf"), "\\xe0\\x80\\xaf") << "overlong";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond the last";
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82") << "cut short";
}

TEST(PrintableTest, LinesStayLines) {
  EXPECT_EQ(printable_lines("a\n\tb\x1b\r\n"), "a\n\tb\\x1b\\x0d\n");
}

TEST(PrintableTest, AnyBytesAreFitForJsonAndChangeOnlyOnce) {
  EXPECT_TRUE(rc::check("printable", [](const std::string& bytes) {
    const std::string shown = printable(bytes);
    RC_ASSERT(printable(shown) == shown);
    RC_ASSERT(std::none_of(shown.begin(), shown.end(), [](char c) { return c >= 0 && c < ' '; }));
    // Throws where a text is not UTF-8; somebody else's decoder.
    RC_ASSERT(nlohmann::json::parse(nlohmann::json(shown).dump()) == shown);
  }));
}

}  // namespace
}  // namespace sonoglide::process::printable_test
