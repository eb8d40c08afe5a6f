/// `sonoglide identify friction` from outside.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/acceptance/program/page_words.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::identify_friction_command_test {
namespace {

using Entries = std::vector<std::string>;

const std::string heading = "velocity_ratio,sliding_velocity_m_per_s,frequency_Hz,friction_ratio\n";

/// Near a Dahl contact with Kt X/Fc = 2.023.
const std::string dahl_rows =
    heading +
    "0.1,0.01,26e3,0.0886\n0.1,0.01,26e3,0.0877\n0.5,0.05,26e3,0.4899\n0.5,0.05,26e3,0.4887\n"
    "0.9,0.09,26e3,0.9449\n0.9,0.09,26e3,0.9458\n";

double ratio_of_scene(ScratchFolder& folder) {
  const Outcome run = folder.run("run out/f_friction/scene.toml --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return nlohmann::json::parse(run.out)["friction_ratio"]["window"].get<double>();
}

TEST(IdentifyFrictionCommand, WritesALawWithIntervalsAndASceneThatRuns) {
  ScratchFolder folder;
  folder.write("f.csv", dahl_rows);
  const Outcome outcome = folder.run("identify friction f.csv --law dahl --law coulomb");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "no progress bar on a pipe";
  EXPECT_NE(
      outcome.out.find("scene: out/f_friction/scene.toml\nreport: out/f_friction/report.html\n"),
      std::string::npos);
  EXPECT_NE(outcome.out.find("\nCoulomb                coulomb            along "),
            std::string::npos)
      << "as --law takes it: " << outcome.out;
  const auto json = nlohmann::json::parse(folder.read("out/f_friction/identify.json"));
  EXPECT_EQ(json["law"], "dahl");
  EXPECT_EQ(json["laws"].size(), 2U);
  const auto& number = json["parameters"]["dahl_number_at_largest_vibration"];
  EXPECT_LT(number["low_95"].get<double>(), 2.023);
  EXPECT_GT(number["high_95"].get<double>(), 2.023);
  EXPECT_TRUE(json.contains("residual_rms") && json.contains("misfit"));
  // What no interval holds reaches whoever reads: here, on the page and in the file.
  const std::string scale = "Were the vibrations 1 % larger than stated: ";
  EXPECT_NE(json["cannot_tell"].dump().find("Dahl: the intervals hold no error"),
            std::string::npos);
  EXPECT_NE(json["cannot_tell"].dump().find(scale), std::string::npos);
  EXPECT_NE(outcome.out.find(scale), std::string::npos) << outcome.out;
  EXPECT_NE(folder.read("out/f_friction/report.html").find(scale), std::string::npos);
  EXPECT_EQ(unexplained_symbols(folder.read("out/f_friction/report.html")), Entries{});
  // The middle reading has a velocity ratio of 0.5.
  EXPECT_NEAR(ratio_of_scene(folder), 0.48927, 0.003);
}

/// Every law that can be the best one has a scene with the friction ratio of the fit.
TEST(IdentifyFrictionCommand, EveryLawsSceneHasItsRatio) {
  const Entries laws = {"coulomb",       "dahl", "iwan", "stribeck", "lugre", "transverse_coulomb",
                        "normal_coulomb"};
  for (const std::string& law : laws) {
    ScratchFolder folder;
    folder.write("f.csv", dahl_rows);
    const Outcome outcome = folder.run("identify friction f.csv --quiet --law " + law);
    ASSERT_EQ(outcome.exit_code, 0) << law << outcome.err;
    const auto json = nlohmann::json::parse(folder.read("out/f_friction/identify.json"));
    // Both residuals of the middle velocity ratio are within the largest one of the fit.
    const double rms = json["residual_rms"].get<double>();
    EXPECT_NEAR(ratio_of_scene(folder), 0.4893, 2.5 * rms + 0.005) << law;
  }
}

/// A scene of other readings would pass for theirs.
TEST(IdentifyFrictionCommand, AnEarlierSceneIsTakenAwayWhereThereIsNone) {
  ScratchFolder folder;
  folder.write("f.csv", dahl_rows);
  ASSERT_EQ(folder.run("identify friction f.csv --law coulomb --out o").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "o/scene.toml"));
  folder.write("f.csv", heading + "0.5,1e-10,1,0.33\n0.33,1e-10,1,0.22\n");
  const Outcome without = folder.run("identify friction f.csv --law coulomb --out o");
  ASSERT_EQ(without.exit_code, 0) << without.err;
  EXPECT_NE(without.out.find("No scene.toml is written"), std::string::npos) << without.out;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "o/scene.toml"));
}

TEST(IdentifyFrictionCommand, BadInputEndsWithTwoAndWritesNothing) {
  ScratchFolder folder;
  folder.write("f.csv", heading + "0.5,0.05,26e3,0.4\n0.5,0.05,26e3,76\n");
  const Outcome value = folder.run("identify friction f.csv");
  EXPECT_EQ(value.exit_code, 2);
  EXPECT_EQ(value.err.rfind("f.csv:3:15: friction_ratio: ", 0), 0U) << value.err;
  EXPECT_EQ(folder.run("identify friction none.csv").exit_code, 2);
  const Outcome law = folder.run("identify friction f.csv --law viscous");
  EXPECT_EQ(law.exit_code, 2);
  EXPECT_NE(law.err.find("allowed: coulomb, dahl"), std::string::npos) << law.err;
  EXPECT_EQ(folder.entries(), Entries{"f.csv"});
}

}  // namespace
}  // namespace sonoglide::acceptance::identify_friction_command_test
