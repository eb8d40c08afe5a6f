/// Against what the standard of ECMAScript says of these patterns, worked out by hand.
#include "host_sim/process/regular_expression.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace sonoglide::process {
namespace {

const RegularExpression number("(-)?([0-9]+)");

TEST(RegularExpression, MatchesTheWholeTextAndSearchesInsideIt) {
  EXPECT_EQ(number.match("-12"), (Match{"-12", "-", "12"}));
  EXPECT_EQ(number.match("a-12"), Match());
  EXPECT_EQ(number.search("a-12, 3"), (Match{"-12", "-", "12"}));
  EXPECT_EQ(number.search("a"), Match());
}

TEST(RegularExpression, AGroupThatTookNoPartIsEmpty) {
  EXPECT_EQ(number.match("12"), (Match{"12", "", "12"}));
}

TEST(RegularExpression, FindsAndReplacesEveryPlace) {
  EXPECT_EQ(number.search_all("1-2, 3"),
            (std::vector<Match>{{"1", "", "1"}, {"-2", "-", "2"}, {"3", "", "3"}}));
  EXPECT_EQ(number.replace("1-2, 3", "<$2>"), "<1><2>, <3>");
  EXPECT_EQ(number.replace("a", "b"), "a");
}

TEST(RegularExpression, APatternThatIsNoneThrows) {
  EXPECT_THROW(RegularExpression("("), std::runtime_error);
}

}  // namespace
}  // namespace sonoglide::process
