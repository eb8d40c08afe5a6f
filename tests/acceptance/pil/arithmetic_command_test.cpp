// Error against run time of a controller, by arithmetic.
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image_cache.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::acceptance::arithmetic_command_test {
namespace {

using Entries = std::vector<std::string>;

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

  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline Outcome outcome_;
};

TEST_F(ArithmeticCommandTest, WritesItsFilesAndPrintsTheTable) {
  EXPECT_EQ(outcome_.exit_code, 0) << outcome_.err;
  EXPECT_EQ(outcome_.err, "") << "no progress bar on a pipe";
  EXPECT_NE(outcome_.out.find("Cortex-M4F  q15 "), std::string::npos) << outcome_.out;
  EXPECT_NE(outcome_.out.find("results/report.html"), std::string::npos) << outcome_.out;
  EXPECT_EQ(folder_->entries(),
            (Entries{"results", "results/.sonoglide", "results/arithmetic.csv",
                     "results/arithmetic.svg", "results/report.html", "results/targets.csv"}));
}

TEST_F(ArithmeticCommandTest, EachArithmeticIsAsNearToFloat64AsItsBitsAllow) {
  const csv::Table table(folder_->read("results/arithmetic.csv"));
  const std::vector<csv::Row>& lines = table.rows();
  ASSERT_EQ(lines.size(), 3U) << "float64 has no hardware there";
  const std::vector<std::string> arithmetics = {"q15", "q31", "float32"};
  const std::vector<double> bounds = {1e-3, 1e-7, 1e-6};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].text("arithmetic"), arithmetics[i]);
    EXPECT_EQ(lines[i].text("board"), "mps2-an386");
    EXPECT_EQ(lines[i].text("fault"), "none");
    EXPECT_GT(lines[i].number("rms_difference"), 0.0);
    EXPECT_LT(lines[i].number("rms_difference"), lines[i].number("largest_difference"));
    EXPECT_LT(lines[i].number("largest_difference"), bounds[i]);
    EXPECT_LT(lines[i].number("steady_error"), 1e-3);
    EXPECT_LT(lines[i].number("ripple"), 1e-3);
  }
}

TEST_F(ArithmeticCommandTest, CountsWhatTheImageAloneCosts) {
  const csv::Table table(folder_->read("results/arithmetic.csv"));
  const csv::Row& q15 = table.row_of("arithmetic", "q15");
  const Outcome outcome = folder_->run("pil '" SONOGLIDE_SCENES
                                       "/target_step_q15.toml' --board mps2-an386 --out image");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json pil = nlohmann::json::parse(folder_->read("image/summary.json")).at("pil");
  EXPECT_EQ(q15.number("instructions_min"), pil.at("instructions_per_step").at("min"));
  EXPECT_NEAR(q15.number("instructions_mean"), pil.at("instructions_per_step").at("mean"), 0.01);
  EXPECT_EQ(q15.number("instructions_max"), pil.at("instructions_per_step").at("max"));
  EXPECT_EQ(q15.number("flash_bytes"), pil.at("flash_bytes"));
  EXPECT_EQ(q15.number("ram_bytes"), pil.at("ram_bytes"));
}

TEST_F(ArithmeticCommandTest, GoesThroughTheTargets) {
  const csv::Table table(folder_->read("results/targets.csv"));
  ASSERT_EQ(table.rows().size(), 19U * 4U);
  for (const csv::Row& line : table.rows()) {
    const bool in_reach = line.text("target") != "0.05";  // of the actuator
    EXPECT_EQ(line.text("limit"), in_reach ? "none" : "actuator") << line.text("target");
    EXPECT_EQ(line.text("ripple") == "nan", !in_reach);
    EXPECT_LT(line.number("largest_difference"), 1e-3);
    EXPECT_EQ(line.number("largest_difference") == 0.0, line.text("arithmetic") == "float64");
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
  const Outcome board =
      folder.run("arithmetic '" SONOGLIDE_SCENES "/target_step.toml' --board uno");
  EXPECT_EQ(board.exit_code, 2);
  EXPECT_NE(board.err.find("\"uno\" is no board; allowed: microbit, "), std::string::npos)
      << board.err;
  for (const char* scene : {"wire_bonder", "damped_step"}) {
    const Outcome observing =
        folder.run("arithmetic '" SONOGLIDE_SCENES "/" + std::string(scene) + ".toml'");
    EXPECT_EQ(observing.exit_code, 2);
    EXPECT_NE(observing.err.find("controller.vibration: "), std::string::npos) << observing.err;
    EXPECT_NE(observing.err.find(" is not built in q15"), std::string::npos) << observing.err;
  }
  const Outcome tracked = folder.run("arithmetic '" SONOGLIDE_SCENES
                                     "/target_step.toml' --set controller.friction=tracked");
  EXPECT_EQ(tracked.exit_code, 2);
  EXPECT_NE(tracked.err.find("controller.friction: "), std::string::npos) << tracked.err;
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace sonoglide::acceptance::arithmetic_command_test
