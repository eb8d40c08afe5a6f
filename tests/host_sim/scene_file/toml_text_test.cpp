#include "host_sim/scene_file/toml_text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace sonoglide::scene_file::toml_text_test {
namespace {

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += part;
  }
  return text;
}

bool is_excessive(const std::string& text) {
  return find_excess_dot(text).has_value();
}

TEST(DottedDepthTest, BoundsKeys) {
  EXPECT_FALSE(is_excessive(repeated("a.", max_dots) + "a = 1"));
  EXPECT_TRUE(is_excessive(repeated("a.", max_dots + 1) + "a = 1"));
  EXPECT_EQ(find_excess_dot("\n" + repeated("a.", max_dots + 1)), 2U * max_dots + 2U);
}

TEST(DottedDepthTest, BoundsQuotedAndSpacedKeys) {
  EXPECT_TRUE(is_excessive(repeated("\",\".", max_dots + 1) + "a = 1"));
  EXPECT_TRUE(is_excessive(repeated("'#'.", max_dots + 1) + "a = 1"));
  EXPECT_TRUE(is_excessive(repeated("\"\\\"\".", max_dots + 1) + "a = 1"));
  EXPECT_TRUE(is_excessive(repeated("a\t . ", max_dots + 1) + "a = 1"));
  EXPECT_TRUE(is_excessive("x = {" + repeated("a.", max_dots + 1) + "a = 1}"));
  EXPECT_TRUE(is_excessive("# it's\n" + repeated("a.", max_dots + 1) + "a = 1"));
}

TEST(DottedDepthTest, LeavesNumbersStringsAndCommentsAlone) {
  EXPECT_FALSE(is_excessive("x = [" + repeated("[0.5, 1.5], ", 100) + "]"));
  EXPECT_FALSE(is_excessive("x = \"" + repeated("a.", 100) + "\""));
  EXPECT_FALSE(is_excessive("x = '" + repeated("a.", 100) + "'"));
  EXPECT_FALSE(is_excessive("x = \"\"\"" + repeated("a.\n", 100) + "\"\"\""));
  EXPECT_FALSE(is_excessive("x = '''" + repeated("'.", 100) + "'''"));
  EXPECT_FALSE(is_excessive("# " + repeated(". ", 100)));
}

TEST(DottedDepthTest, EndsWithTheText) {
  for (const char* text : {"", "\"", "'", "\"\\", "\"\"\"", "'''a", "#", "."}) {
    EXPECT_FALSE(is_excessive(text)) << text;
  }
}

}  // namespace
}  // namespace sonoglide::scene_file::toml_text_test
