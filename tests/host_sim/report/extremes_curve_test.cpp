#include "host_sim/report/extremes_curve.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sonoglide::report::extremes_curve_test {
namespace {

using Curve = ExtremesCurve<2>;

/// Values at x = 0, 1, 2, …; the second ordinate is the negative of the first.
Curve curve_of(const std::vector<double>& values, std::size_t most_points) {
  Curve curve(most_points);
  for (std::size_t i = 0; i < values.size(); ++i) {
    curve.add(static_cast<double>(i), {values[i], -values[i]});
  }
  return curve;
}

TEST(ExtremesCurveTest, IsCompleteWhileItFits) {
  const std::vector<double> values{3.0, -1.0, 4.0, 1.5};
  const Curve curve = curve_of(values, 4);
  EXPECT_EQ(curve.piece_size(), 1U);
  EXPECT_EQ(curve.x(), (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
  EXPECT_EQ(curve.y(0), values);
  EXPECT_EQ(curve.y(1), (std::vector<double>{-3.0, 1.0, -4.0, -1.5}));
}

TEST(ExtremesCurveTest, OfNothingIsEmpty) {
  EXPECT_TRUE(Curve(8).x().empty());
  EXPECT_TRUE(Curve(8).y(1).empty());
}

TEST(ExtremesCurveTest, KeepsTheExtremesOfEachPieceInTheirOrder) {
  // Eight points at most: 8 points join to pairs, which are as many, and again to fours.
  const Curve curve = curve_of({1, 9, 5, 2, 7, 3, 0, 4, 6}, 8);
  EXPECT_EQ(curve.piece_size(), 4U);
  EXPECT_EQ(curve.x(), (std::vector<double>{0, 2, 4, 6, 8, 8}));
  EXPECT_EQ(curve.y(0), (std::vector<double>{1, 9, 7, 0, 6, 6}));
  EXPECT_EQ(curve.y(1), (std::vector<double>{-1, -9, -7, 0, -6, -6}));
}

TEST(ExtremesCurveTest, PassesOverWhatIsNotANumber) {
  const double gap = std::nan("");
  const Curve curve = curve_of({gap, 2, 1, gap, gap, gap, gap, gap, gap}, 8);
  const std::vector<double> y = curve.y(0);
  ASSERT_EQ(y.size(), 6U);
  EXPECT_EQ(y[0], 2.0);
  EXPECT_EQ(y[1], 1.0);
  EXPECT_TRUE(std::all_of(y.begin() + 2, y.end(), [](double value) { return std::isnan(value); }));
}

TEST(ExtremesCurveTest, OneExcursionInAMillionIsSeen) {
  Curve curve(20000);
  for (int i = 0; i < 1000000; ++i) {
    curve.add(i, {i == 765432 ? 0.9 : 0.5, 0.0});
  }
  const std::vector<double> y = curve.y(0);
  EXPECT_LE(y.size(), 20000U);
  EXPECT_EQ(std::count(y.begin(), y.end(), 0.9), 1);
  const auto place = static_cast<std::size_t>(std::find(y.begin(), y.end(), 0.9) - y.begin());
  EXPECT_NEAR(curve.x()[place], 765432.0, static_cast<double>(curve.piece_size()));
}

// The oracle is a plain scan of the whole course.
TEST(ExtremesCurveTest, EveryPieceHoldsTheExtremesOfItsPoints) {
  EXPECT_TRUE(rc::check([] {
    const auto whole_numbers = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-9, 10));
    const std::vector<double> values(whole_numbers.begin(), whole_numbers.end());
    const std::size_t most_points = *rc::gen::element<std::size_t>(4, 6, 8, 10, 14);
    const Curve curve = curve_of(values, most_points);
    const std::vector<double> x = curve.x();
    const std::vector<double> y = curve.y(0);
    RC_ASSERT(x.size() == y.size() && x.size() <= most_points);
    RC_ASSERT(std::is_sorted(x.begin(), x.end()));
    if (curve.piece_size() == 1) {
      RC_ASSERT(y == values);
      return;
    }
    const std::size_t size = curve.piece_size();
    RC_ASSERT(x.size() / 2 == (values.size() + size - 1) / size);
    for (std::size_t piece = 0; piece < x.size() / 2; ++piece) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(piece * size);
      const auto last =
          values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), (piece + 1) * size));
      const auto [low, high] = std::minmax(y[2 * piece], y[2 * piece + 1]);
      RC_ASSERT(low == *std::min_element(first, last));
      RC_ASSERT(high == *std::max_element(first, last));
      RC_ASSERT(std::find(first, last, y[2 * piece]) <= std::find(first, last, y[2 * piece + 1]));
      RC_ASSERT(x[2 * piece] == static_cast<double>(piece * size));
    }
  }));
}

}  // namespace
}  // namespace sonoglide::report::extremes_curve_test
