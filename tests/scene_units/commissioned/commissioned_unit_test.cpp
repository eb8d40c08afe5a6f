/// A unit in a plant that nobody has told its controller of, and the program that finds out.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "host_sim/process/regular_expression.hpp"
#include "stand.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/acceptance/program/started_program.hpp"

namespace sonoglide::app::scene_units_test {
namespace {

TEST(CommissionedUnit, ItsPlantIsFound) {
  const Stand stand({"sensor.adc_bits=12", "true_values.plant.stiffness_N_per_m=120e6",
                     "true_values.friction.coefficient=0.12",
                     "true_values.friction.contact_stiffness_N_per_m=0.04e6",
                     "true_values.plant.damping_N_s_per_m=10"});
  const acceptance::ScratchFolder folder;
  folder.write("before", "target 0.7\n");
  ASSERT_EQ(folder.run("connect " + stand.device() + " < before").exit_code, 0);
  const acceptance::Outcome run =
      folder.run("commission " + stand.device() +
                 " " SONOGLIDE_TARGET_STEP " --set sensor.adc_bits=12 --out found");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  folder.write("after", "status\n");
  const std::string after = folder.run("connect " + stand.device() + " --quiet < after").out;
  EXPECT_EQ(after.rfind("state off, target 0.7,", 0), 0U) << after;
  const auto found = nlohmann::json::parse(folder.read("found/identify.json"));
  const auto& all = found["parameters"];
  EXPECT_NEAR(all["plant.stiffness_N_per_m"]["value"], 120e6, 120e6 * 1e-4) << found.dump(1);
  EXPECT_NEAR(all["friction.coefficient"]["value"], 0.12, 0.12 * 1e-3);
  EXPECT_NEAR(all["friction.contact_stiffness_N_per_m"]["value"], 0.04e6, 0.04e6 * 2e-2);
  EXPECT_NEAR(all["plant.damping_N_s_per_m"]["value"], 10.0, 2.0);
  EXPECT_TRUE(found["warnings"].empty()) << found["warnings"];
  // The scene that it leaves settles where that of the unit does not.
  const acceptance::Outcome commissioned = folder.run("run found/commissioned.toml --json");
  ASSERT_EQ(commissioned.exit_code, 0) << commissioned.err;
  for (const auto& step : nlohmann::json::parse(commissioned.out)["control"]["steps"]) {
    EXPECT_LT(step["settling_time_s"], 1e-3);
  }
}

/// It has no host_timeout that would do so.
TEST(CommissionedUnit, IsStoppedByAnInterrupt) {
  const Stand stand({});
  const acceptance::ScratchFolder folder;
  acceptance::StartedProgram program(
      folder, {"commission", stand.device(), SONOGLIDE_TARGET_STEP, "--quiet"}, folder);
  ASSERT_TRUE(
      acceptance::comes_true([&] { return stand.port().amplitude() > 0 || program.has_ended(); }));
  program.send(SIGINT);
  const int status = program.end();
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
  EXPECT_TRUE(acceptance::comes_true([&] { return stand.port().amplitude() == 0; }));
}

TEST(CommissionedUnit, AStepOfItsLoopIsMeasured) {
  const Stand stand({});
  const acceptance::ScratchFolder folder;
  folder.write("lines", "restart\nstep 0.4 0.7 step.html\n");
  const acceptance::Outcome run = folder.run("connect " + stand.device() + " --quiet < lines");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  const process::RegularExpression pattern(
      "the friction force goes from ([0-9.]+) mN to ([0-9.]+) mN, ripple .*; 10 to 90 % in ([0-9.]+) us, within 5 % of "
      "the step after ([0-9.]+) (us|ms), overshoot");
  const process::Match found = pattern.search(run.out);
  ASSERT_FALSE(found.empty()) << run.out;
  constexpr double undriven_mN = 39.24 * 0.5;
  EXPECT_NEAR(std::stod(found[1]), 0.4 * undriven_mN, 0.02 * undriven_mN) << run.out;
  EXPECT_NEAR(std::stod(found[2]), 0.7 * undriven_mN, 0.02 * undriven_mN) << run.out;
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{".sonoglide", "lines", "step.html"}));
}

TEST(CommissionedUnit, OfAnotherSceneIsLeftAlone) {
  const Stand stand({});
  const acceptance::ScratchFolder folder;
  const acceptance::Outcome run =
      folder.run("commission " + stand.device() +
                 " " SONOGLIDE_TARGET_STEP " --set plant.stiffness_N_per_m=120e6 --out found");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("the unit has another design than the scene"), std::string::npos)
      << run.err;
  EXPECT_TRUE(folder.entries().empty());
  EXPECT_EQ(stand.port().largest_amplitude(), 0);
}

}  // namespace
}  // namespace sonoglide::app::scene_units_test
