// Error against run time of a controller, by arithmetic.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image_cache.hpp"
#include "tests/acceptance/program/csv.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance {
namespace {

using Entries = std::vector<std::string>;
/// A line of a table by its headings.
using Line = std::map<std::string, std::string>;

std::vector<Line> lines_of(const std::string& csv) {
  const std::vector<Cells> rows = csv_rows(csv);
  std::vector<Line> lines;
  for (std::size_t row = 1; row < rows.size(); ++row) {
    EXPECT_EQ(rows[row].size(), rows[0].size()) << row;
    Line& line = lines.emplace_back();
    for (std::size_t i = 0; i < rows[row].size(); ++i) {
      line[rows[0].at(i)] = rows[row][i];
    }
  }
  return lines;
}

double number(const Line& line, const std::string& heading) {
  return std::strtod(line.at(heading).c_str(), nullptr);
}

/// One comparison, looked at from all sides.
class ArithmeticCommandTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    use_image_cache();
    folder_ = std::make_unique<ScratchFolder>();
    outcome_ = folder_->run("arithmetic '" SONOGLIDE_SCENES
                            "/target_step.toml' --board mps2-an386 --out results");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::unique_ptr<ScratchFolder> folder_;
  static Outcome outcome_;
};

std::unique_ptr<ScratchFolder> ArithmeticCommandTest::folder_;
Outcome ArithmeticCommandTest::outcome_;

TEST_F(ArithmeticCommandTest, WritesItsThreeFilesAndPrintsTheTable) {
  EXPECT_EQ(outcome_.exit_code, 0) << outcome_.err;
  EXPECT_EQ(outcome_.err, "") << "no progress bar on a pipe";
  EXPECT_NE(outcome_.out.find("Cortex-M4F  q15 "), std::string::npos) << outcome_.out;
  EXPECT_NE(outcome_.out.find("results/arithmetic.svg"), std::string::npos) << outcome_.out;
  EXPECT_EQ(folder_->entries(), (Entries{"results", "results/.sonoglide", "results/arithmetic.csv",
                                         "results/arithmetic.svg", "results/targets.csv"}));
}

TEST_F(ArithmeticCommandTest, EachArithmeticIsAsNearToFloat64AsItsBitsAllow) {
  const std::vector<Line> lines = lines_of(folder_->read("results/arithmetic.csv"));
  ASSERT_EQ(lines.size(), 3U) << "float64 has no hardware there";
  const std::vector<std::string> arithmetics = {"q15", "q31", "float32"};
  const std::vector<double> bounds = {1e-3, 1e-7, 1e-6};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].at("arithmetic"), arithmetics[i]);
    EXPECT_EQ(lines[i].at("board"), "mps2-an386");
    EXPECT_EQ(lines[i].at("fault"), "none");
    EXPECT_GT(number(lines[i], "rms_difference"), 0.0);
    EXPECT_LT(number(lines[i], "rms_difference"), number(lines[i], "largest_difference"));
    EXPECT_LT(number(lines[i], "largest_difference"), bounds[i]);
    EXPECT_LT(number(lines[i], "steady_error"), 1e-3);
    EXPECT_LT(number(lines[i], "ripple"), 1e-3);
  }
}

TEST_F(ArithmeticCommandTest, CountsWhatTheImageAloneCosts) {
  const Line q15 = lines_of(folder_->read("results/arithmetic.csv")).front();
  const Outcome outcome = folder_->run("pil '" SONOGLIDE_SCENES
                                       "/target_step_q15.toml' --board mps2-an386 --out image");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json pil = nlohmann::json::parse(folder_->read("image/summary.json")).at("pil");
  EXPECT_EQ(number(q15, "instructions_min"), pil.at("instructions_per_step").at("min"));
  EXPECT_NEAR(number(q15, "instructions_mean"), pil.at("instructions_per_step").at("mean"), 0.01);
  EXPECT_EQ(number(q15, "instructions_max"), pil.at("instructions_per_step").at("max"));
  EXPECT_EQ(number(q15, "flash_bytes"), pil.at("flash_bytes"));
  EXPECT_EQ(number(q15, "ram_bytes"), pil.at("ram_bytes"));
}

TEST_F(ArithmeticCommandTest, GoesThroughTheTargets) {
  const std::vector<Line> lines = lines_of(folder_->read("results/targets.csv"));
  ASSERT_EQ(lines.size(), 19U * 4U);
  for (const Line& line : lines) {
    const bool in_reach = line.at("target") != "0.05";  // of the actuator
    EXPECT_EQ(line.at("limit"), in_reach ? "none" : "actuator") << line.at("target");
    EXPECT_EQ(line.at("ripple") == "nan", !in_reach);
    EXPECT_LT(number(line, "largest_difference"), 1e-3);
    EXPECT_EQ(number(line, "largest_difference") == 0.0, line.at("arithmetic") == "float64");
  }
}

TEST_F(ArithmeticCommandTest, ThePictureNamesItsLinesAndAxes) {
  const std::string svg = folder_->read("results/arithmetic.svg");
  for (const char* text : {"q15", "q31", "float32", "Cortex-M4F", "Instructions per control step",
                           "rms difference from float64", "Target friction ratio"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
}

TEST_F(ArithmeticCommandTest, RefusesWhatItCannotCompare) {
  const ScratchFolder folder;
  const Outcome open_loop = folder.run("arithmetic '" SONOGLIDE_SCENES "/table_1_open_loop.toml'");
  EXPECT_EQ(open_loop.exit_code, 2);
  EXPECT_NE(open_loop.err.find("table_1_open_loop.toml:1:1: controller: missing"),
            std::string::npos)
      << open_loop.err;
  const Outcome board =
      folder.run("arithmetic '" SONOGLIDE_SCENES "/target_step.toml' --board uno");
  EXPECT_EQ(board.exit_code, 2);
  EXPECT_NE(board.err.find("\"uno\" is no board; allowed: microbit, "), std::string::npos)
      << board.err;
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace sonoglide::acceptance
