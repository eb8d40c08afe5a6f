/// Pictures come out whole, or the reason why not.

#include "host_sim/output/gnuplot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "host_sim/process/pipe.hpp"
#include "host_sim/process/scratch_folder.hpp"

namespace sonoglide::output::gnuplot_test {
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
  } catch (const process::ProcessError& error) {
    EXPECT_NE(std::string(error.what()).find("plott"), std::string::npos) << error.what();
  }
}

// Left to itself gnuplot ends with "x range is invalid".
TEST(Gnuplot, APlotWithoutAPointHasItsRangesSet) {
  const std::string plot = "$none << EOD\nNaN NaN\n-1 -1\nEOD\nplot $none with lines\n";
  const std::vector<double> values = {std::nan(""), -1.0};
  std::string ranges = "set logscale xy\n";
  EXPECT_THROW(draw_svg(ranges + plot, 640, 480), process::ProcessError);
  for (const char axis : {'x', 'y'}) {
    ranges += range_command(axis, values, Scale::logarithmic, 5.0);
    EXPECT_EQ(range_command(axis, values, Scale::linear, 5.0),
              std::string("set ") + axis + "range [*:*]\n");
  }
  EXPECT_NE(draw_svg(ranges + plot, 640, 480).find("</svg>"), std::string::npos);
}

TEST(Gnuplot, DrawsWithoutAPlaceForTemporaryFiles) {
  setenv("TMPDIR", "/nowhere", 1);
  const std::string svg = draw_svg("plot x\n", 640, 480);
  unsetenv("TMPDIR");
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

// The picture is the same whatever the user has told gnuplot, and in any locale.
TEST(Gnuplot, KnowsNoSettingOfTheUsers) {
  const std::string plain = draw_svg("plot x\n", 640, 480);
  const process::ScratchFolder home(std::filesystem::temp_directory_path());
  std::ofstream(home.path() / ".gnuplot") << "set title 'mine'\nset grid\nunset key\n";
  const std::string usual_home = std::getenv("HOME");
  setenv("HOME", home.path().c_str(), 1);
  setenv("GNUTERM", "nonsense", 1);
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  const std::string mine = draw_svg("plot x\n", 640, 480);
  setenv("HOME", usual_home.c_str(), 1);
  unsetenv("GNUTERM");
  unsetenv("LC_ALL");
  EXPECT_EQ(mine, plain);
}

// None is a command, ends its string, or is taken for mark-up.
TEST(Gnuplot, AnyTextIsATitle) {
  const process::ScratchFolder home(std::filesystem::temp_directory_path());
  const std::string pwned = (home.path() / "pwned").string();
  const std::vector<std::string> texts = {"it's",
                                          "'",
                                          "''",
                                          "'a'",
                                          "a''b",
                                          "\"",
                                          "\\\"",
                                          "'; system(\"touch " + pwned + "\") #",
                                          "`touch " + pwned + "`",
                                          "$(touch " + pwned + ")",
                                          "@pwned",
                                          "%s %d %",
                                          "{/Bold x} a_b ^c ~d",
                                          "ends in \\",
                                          "a\n!touch " + pwned + "\n",
                                          "\xff\xfe",
                                          "\x1b[31m",
                                          "# ; & <b>"};
  for (const std::string& text : texts) {
    const std::string svg = draw_svg("pwned = 'system(\"touch " + pwned + "\")'\nset title " +
                                         output::quoted(text) + " noenhanced\nplot x\n",
                                     640, 480);
    EXPECT_NE(svg.find("</svg>"), std::string::npos) << text;
    EXPECT_FALSE(std::filesystem::exists(pwned)) << text;
  }
  EXPECT_NE(
      draw_svg("set title " + output::quoted("it's {a} _b") + " noenhanced\nplot x\n", 640, 480)
          .find(">it's {a} _b<"),
      std::string::npos);
}

TEST(Gnuplot, SaysWhatToInstall) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  std::string what;
  try {
    require_gnuplot();
  } catch (const process::ProcessError& error) {
    what = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(what, "gnuplot: is not installed; on Debian: apt-get install gnuplot-nox");
}

}  // namespace
}  // namespace sonoglide::output::gnuplot_test
