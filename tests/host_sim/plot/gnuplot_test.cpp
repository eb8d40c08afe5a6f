/// Pictures come out whole, or the reason why not.

#include "host_sim/plot/gnuplot.hpp"

#include <gtest/gtest.h>

namespace sonoglide::plot {
namespace {

TEST(Gnuplot, DrawsAnSvgOfTheSizeAskedFor) {
  const std::string svg =
      draw_svg("$points << EOD\n0 1\n1 3\nEOD\nplot $points with lines\n", 640, 480);
  EXPECT_EQ(svg.rfind("<?xml", 0), 0U);
  EXPECT_NE(svg.find("viewBox=\"0 0 640 480\""), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(Gnuplot, SaysWhatItDidNotUnderstand) {
  try {
    draw_svg("plott 1\n", 640, 480);
    FAIL() << "a bad script was drawn";
  } catch (const PlotError& error) {
    EXPECT_NE(std::string(error.what()).find("plott"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sonoglide::plot
