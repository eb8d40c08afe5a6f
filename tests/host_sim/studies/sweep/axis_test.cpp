#include "host_sim/studies/sweep/plan.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "host_sim/scene_file/scene_error.hpp"

namespace sonoglide::sweep::axis_test {
namespace {

std::vector<double> values(const std::string& text) {
  const Axis axis = parse_axis(text, 1);
  std::vector<double> all;
  for (std::size_t i = 0; i < axis.count; ++i) {
    all.push_back(axis.number(i));
  }
  return all;
}

std::string error_of(const std::string& text) {
  try {
    parse_axis(text, 3);
  } catch (const scene_file::SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(AxisTest, IsEvenlySpacedInEitherDirection) {
  EXPECT_EQ(values("a.b=1:3:5"), (std::vector<double>{1.0, 1.5, 2.0, 2.5, 3.0}));
  EXPECT_EQ(values("a.b=3:-3:3"), (std::vector<double>{3.0, 0.0, -3.0}));
  EXPECT_EQ(values("a.b=7:7:1"), std::vector<double>{7.0});
}

TEST(AxisTest, KeepsWholeNumbersWhole) {
  EXPECT_EQ(values("a.b=4:16:5"), (std::vector<double>{4.0, 7.0, 10.0, 13.0, 16.0}));
}

TEST(AxisTest, ALogarithmicOneHasDecadesToTheBit) {
  EXPECT_EQ(values("a.b=1e4:1e8:5:log"), (std::vector<double>{1e4, 1e5, 1e6, 1e7, 1e8}));
  EXPECT_EQ(values("a.b=-100:-1:3:log"), (std::vector<double>{-100.0, -10.0, -1.0}));
}

TEST(AxisTest, HitsBothEndsAndStaysInOrder) {
  EXPECT_TRUE(rc::check("ends are exact, values ordered", [] {
    const double from = std::pow(10.0, *rc::gen::inRange(-300, 300) / 10.0);
    const double to = std::pow(10.0, *rc::gen::inRange(-300, 300) / 10.0);
    const Axis axis{"a.b", from, to, static_cast<std::size_t>(*rc::gen::inRange(2, 50)),
                    *rc::gen::arbitrary<bool>()};
    RC_ASSERT(axis.number(0) == from);
    RC_ASSERT(axis.number(axis.count - 1) == to);
    for (std::size_t i = 1; i < axis.count; ++i) {
      const double step = axis.number(i) - axis.number(i - 1);
      RC_ASSERT((from < to ? step >= 0.0 : step <= 0.0));
    }
  }));
}

TEST(AxisTest, SurvivesTheLargestRange) {
  for (const double value : values("a.b=-1.7e308:1.7e308:9")) {
    EXPECT_TRUE(std::isfinite(value));
  }
}

TEST(AxisTest, SaysWhatIsWrong) {
  const std::string form = "allowed: KEY=FROM:TO:COUNT, KEY=FROM:TO:COUNT:log or KEY=A,B,...";
  EXPECT_EQ(error_of("=1:2:3"), "--vary:3:1: --vary: no key; " + form);
  EXPECT_EQ(error_of("a.b"), "--vary:3:1: a.b: no values; " + form);
  EXPECT_EQ(error_of("a.b=1:2"), "--vary:3:1: a.b: \"1:2\" is not a range; " + form);
  EXPECT_EQ(error_of("a.b=1:2:3:log:4"),
            "--vary:3:1: a.b: \"1:2:3:log:4\" is not a range; " + form);
  EXPECT_EQ(error_of("a.b=one:2:3"), "--vary:3:1: a.b: FROM \"one\" is not a number; " + form);
  EXPECT_EQ(error_of("a.b=1::3"), "--vary:3:1: a.b: TO \"\" is not a number; " + form);
  EXPECT_EQ(error_of("a.b=1:inf:3"),
            "--vary:3:1: a.b: TO inf is not finite; allowed: a finite number");
  EXPECT_EQ(error_of("a.b=nan:1:3"),
            "--vary:3:1: a.b: FROM nan is not finite; allowed: a finite number");
  for (const char* count : {"0", "-1", "2.5", "", "1000000000001", "99999999999999999999"}) {
    EXPECT_EQ(error_of(std::string("a.b=1:2:") + count),
              "--vary:3:1: a.b: COUNT \"" + std::string(count) +
                  "\"; allowed: a whole number, 1 to 1000000000000");
  }
  EXPECT_EQ(error_of("a.b=1:2:3:lin"), "--vary:3:1: a.b: unknown spacing \"lin\"; " + form);
  for (const char* range : {"0:1", "1:0", "-1:1"}) {
    EXPECT_NE(error_of("a.b=" + std::string(range) + ":3:log").find("has no logarithm"),
              std::string::npos);
  }
  EXPECT_EQ(
      error_of("a.b=7:9:1"),
      "--vary:3:1: a.b: one value from 7 to 9; allowed: FROM equal to TO, or a COUNT above 1");
}

TEST(AxisTest, ListsWordsNumbersAndTruthValues) {
  const Axis axis = parse_axis("a.b=dahl, 1e4,0.5,true,\"x y\"", 1);
  ASSERT_EQ(axis.count, 5U);
  const std::vector<std::string> texts = {"dahl", "10000", "0.5", "true", "x y"};
  for (std::size_t i = 0; i < axis.count; ++i) {
    EXPECT_EQ(axis.text(i), texts[i]);
    EXPECT_EQ(axis.position(i), static_cast<double>(i + 1));
  }
  EXPECT_TRUE(axis.has_words());
  EXPECT_TRUE(axis.categorical());
  EXPECT_TRUE(std::isnan(axis.number(0)));
  EXPECT_EQ(axis.number(1), 1e4);
  EXPECT_TRUE(axis.value(0).node().is_string());
  EXPECT_TRUE(axis.value(1).node().is_integer()) << "as a range gives it";
  EXPECT_TRUE(axis.value(2).node().is_floating_point());
  EXPECT_TRUE(axis.value(3).node().is_boolean());
}

TEST(AxisTest, NumbersInOrderStandOnAScale) {
  EXPECT_FALSE(parse_axis("a.b=1,2,10", 1).categorical());
  EXPECT_FALSE(parse_axis("a.b=10,2,1", 1).categorical());
  EXPECT_TRUE(parse_axis("a.b=1,10,2", 1).categorical());
  EXPECT_FALSE(parse_axis("a.b=1,10,2", 1).has_words());
  EXPECT_EQ(parse_axis("a.b=7", 1).count, 1U);
  EXPECT_EQ(parse_axis("a.b=1,2,10", 1).position(2), 10.0);
}

TEST(AxisTest, SaysWhatIsWrongInAList) {
  const std::string form = "allowed: KEY=FROM:TO:COUNT, KEY=FROM:TO:COUNT:log or KEY=A,B,...";
  EXPECT_EQ(error_of("a.b="), "--vary:3:1: a.b: an empty value; " + form);
  EXPECT_EQ(error_of("a.b=x,,y"), "--vary:3:1: a.b: an empty value; " + form);
  EXPECT_EQ(error_of("a.b=x,y,x"), "--vary:3:1: a.b: x is there twice; allowed: each value once");
  EXPECT_EQ(error_of("a.b=1,1.0"), "--vary:3:1: a.b: 1 is there twice; allowed: each value once");
  EXPECT_EQ(error_of("a.b=[1],x"),
            "--vary:3:1: a.b: \"[1]\" is an array; allowed: numbers, words, true, false");
  EXPECT_NE(error_of("a.b=1:2:3,4").find("--vary:3:1: a.b: "), std::string::npos);
}

TEST(AxisTest, WritesValuesThatReadBackTheSame) {
  EXPECT_EQ(number_text(12.0), "12");
  EXPECT_EQ(number_text(-3.0), "-3");
  EXPECT_EQ(number_text(0.05), "0.05");
  EXPECT_TRUE(rc::check("it reads back the same", [](double x) {
    RC_ASSERT(std::strtod(number_text(x).c_str(), nullptr) == x);
  }));
}

TEST(GridTest, TheFirstAxisIsTheSlowest) {
  const Grid grid({{"a.b", 1.0, 2.0, 2, false}, {"c.d", 10.0, 30.0, 3, false}});
  ASSERT_EQ(grid.size(), 6U);
  std::vector<double> first;
  std::vector<double> second;
  for (std::size_t point = 0; point < grid.size(); ++point) {
    first.push_back(grid.number(point, 0));
    second.push_back(grid.number(point, 1));
  }
  EXPECT_EQ(first, (std::vector<double>{1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(second, (std::vector<double>{10, 20, 30, 10, 20, 30}));
}

TEST(GridTest, HasABound) {
  EXPECT_NO_THROW(Grid({{"a.b", 1.0, 2.0, 1000, false}, {"c.d", 1.0, 2.0, 1000, false}}));
  EXPECT_THROW(Grid({{"a.b", 1.0, 2.0, 1000, false}, {"c.d", 1.0, 2.0, 1001, false}}),
               scene_file::SceneError);
  EXPECT_THROW(Grid({}), scene_file::SceneError);
}

}  // namespace
}  // namespace sonoglide::sweep::axis_test
