#include <gtest/gtest.h>

#include <string>

#include "host_sim/boards/emulated/controller_header.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::configure_command_test {
namespace {

const std::string name = std::string("/") + emulated::controller_header_name;

TEST(ConfigureCommandTest, WritesTheHeaderOfAScene) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run("configure '" SONOGLIDE_SCENES "/target_step.toml'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "header: out/target_step" + name + "\n");
  const std::string header = folder.read("out/target_step" + name);
  EXPECT_NE(header.find("inline constexpr TargetStep<Scalar> target_steps[]"), std::string::npos);
  EXPECT_EQ(folder.run("configure '" SONOGLIDE_SCENES "/target_step.toml' --out other --quiet").out,
            "");
  EXPECT_EQ(folder.read("other" + name), header);
}

TEST(ConfigureCommandTest, WritesThePlantAsWellWhereItIsAskedTo) {
  const std::string plant_name = std::string("/") + emulated::plant_header_name;
  const ScratchFolder folder;
  const std::string scene = "'" SONOGLIDE_SCENES "/target_step.toml'";
  EXPECT_EQ(folder.run("configure " + scene + " --plant float32").out,
            "header: out/target_step" + name + "\nplant:  out/target_step" + plant_name + "\n");
  const std::string header = folder.read("out/target_step" + plant_name);
  EXPECT_NE(header.find("plant::EqualStepStrang<PlantModel>"), std::string::npos) << header;
  EXPECT_NE(header.find("plant_periods = 360;"), std::string::npos) << header;
  EXPECT_EQ(folder.run("configure " + scene + " --plant q31 --out q31").exit_code, 0);
  EXPECT_NE(folder.read("q31" + plant_name).find("FixedPlantBoard"), std::string::npos);
  EXPECT_EQ(folder.run("configure " + scene + " --plant float64 --out other").exit_code, 2);
  EXPECT_EQ(folder.run("configure " + scene + " --quiet").exit_code, 0);
  EXPECT_EQ(folder.read("out/target_step" + plant_name), "") << "that of an earlier call is gone";
}

TEST(ConfigureCommandTest, SaysWhatThePlantOfAnImageCannotFollow) {
  const ScratchFolder folder;
  const Outcome outcome =
      folder.run("configure '" SONOGLIDE_SCENES "/speed_ramp.toml' --plant float32");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("sliding.profile: changes"), std::string::npos) << outcome.err;
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace sonoglide::acceptance::configure_command_test
