/// Scenes whose plant cannot be found while it is driven, by the key that says why.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/studies/identify/plant/study.hpp"
#include "tests/host_sim/studies/identify/plant/commissioned/recorded.hpp"

namespace sonoglide::identify::plant::refusals_test {
namespace {

std::string key_of_refusal(const std::string& scene, const std::vector<std::string>& changes = {}) {
  try {
    require_identifiable(experiment::read_file(SCENES + scene, changes));
  } catch (const configure::ConfigurationError& error) {
    return error.key();
  }
  return "none";
}

TEST(RequireIdentifiable, NamesTheKeyInTheWay) {
  EXPECT_EQ(key_of_refusal("target_step.toml"), "none");
  EXPECT_EQ(key_of_refusal("table_1_open_loop.toml"), "controller");
  EXPECT_EQ(key_of_refusal("wire_bonder.toml"), "sensor.force");
  EXPECT_EQ(key_of_refusal("fingertip.toml"), "load");
  EXPECT_EQ(key_of_refusal("speed_ramp.toml"), "sliding.profile");
  EXPECT_EQ(key_of_refusal("friction_jump.toml"), "friction.coefficient_profile");
  EXPECT_EQ(key_of_refusal("langevin.toml"), "plant.stiffness_profile");
  EXPECT_EQ(key_of_refusal("target_step.toml", {"controller.relearn_every_s=0.01"}),
            "controller.relearn_every_s");
}

TEST(RequireIdentifiable, ALoadIsRefusedInPlainWords) {
  try {
    require_identifiable(experiment::read_file(SCENES "fingertip.toml"));
    FAIL();
  } catch (const configure::ConfigurationError& error) {
    EXPECT_STREQ(
        error.what(),
        "the plant is measured at a sliding velocity that is given, and a load's follows from the "
        "forces on it; required: a table [sliding] in its place");
  }
}

std::string reason_against(const std::vector<std::string>& unit) {
  const configure::Experiment scene = experiment::read_file(SCENES "target_step.toml");
  const configure::Experiment recorded = experiment::read_file(SCENES "target_step.toml", unit);
  try {
    study(scene, test::recorded(recorded, {0.9, 0.4}, 64, 32), [](double) {});
  } catch (const loop::ComputationError& error) {
    return error.what();
  }
  return "";
}

TEST(Study, SensorsThatLieAreNamed) {
  EXPECT_NE(reason_against({"sensor.force_gain=-1"})
                .find("reads -0.01962 N where the scene has 0.01962 N"),
            std::string::npos);
  EXPECT_NE(reason_against({"sensor.force_gain=0"}).find("wired backwards or dead"),
            std::string::npos);
  EXPECT_NE(
      reason_against({"sensor.velocity_gain=0"}).find("the sliding velocity reads next to nothing"),
      std::string::npos);
}

TEST(Targets, StepBetweenAWeakDriveAndTheStrongest) {
  const configure::Experiment scene = experiment::read_file(SCENES "target_step.toml");
  EXPECT_EQ(targets(scene.nominal), (std::vector<double>{0.9, 0.4, 0.9, 0.65, 0.4}));
}

}  // namespace
}  // namespace sonoglide::identify::plant::refusals_test
