#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "firmware/friction/normal_vibration_ratio.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::acceptance::example_scenes_test {
namespace {

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(SONOGLIDE_SCENES)) {
    if (entry.path().extension() == ".toml") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

class ExampleSceneTest : public testing::TestWithParam<std::string> {};

TEST_P(ExampleSceneTest, RunsAndEchoesItself) {
  const ScratchFolder folder;
  const Outcome outcome =
      folder.run("run '" SONOGLIDE_SCENES "/" + GetParam() + ".toml' --out out --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json summary = nlohmann::json::parse(folder.read("out/summary.json"));
  EXPECT_GT(summary.at("scene").at("plant").at("mass_kg"), 0.0);
  if (GetParam().find("open_loop") != std::string::npos) {
    EXPECT_FALSE(summary.at("scene").contains("controller"));
  }
}

INSTANTIATE_TEST_SUITE_P(Folder, ExampleSceneTest, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST(ExampleSceneTest, TheSlidingVelocityOfTable1IsHalfThePeakVibrationVelocity) {
  const ScratchFolder folder;
  const Outcome outcome =
      folder.run("run '" SONOGLIDE_SCENES "/table_1_open_loop.toml' --out out --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json summary = nlohmann::json::parse(folder.read("out/summary.json"));
  // 0.5 w F / |K - m w^2| with w = 2 pi 60e3, to 20 digits.
  EXPECT_DOUBLE_EQ(summary.at("scene").at("sliding").at("velocity_m_per_s"),
                   0.026714794439561916459);
}

/// Of a scene of the folder, with what else the command is given.
double window_ratio(const std::string& scene, const std::string& options = "") {
  const ScratchFolder folder;
  const Outcome outcome =
      folder.run("run '" SONOGLIDE_SCENES "/" + scene + ".toml' --out out " + options + " --quiet");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json summary = nlohmann::json::parse(folder.read("out/summary.json"));
  return summary.at("friction_ratio").at("window");
}

// Voltage and current hardly have harmonics, so that P^2 + Q^2 = S^2.
TEST(ExampleSceneTest, ATransducerTakesThePowersOfItsCircuit) {
  const ScratchFolder folder;
  const Outcome outcome =
      folder.run("run '" SONOGLIDE_SCENES "/wire_bonder_open_loop.toml' --out out --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json summary = nlohmann::json::parse(folder.read("out/summary.json"));
  const nlohmann::json& electrical = summary.at("electrical");
  const double active_W = electrical.at("active_power_W");
  const double apparent_VA = electrical.at("apparent_power_VA");
  EXPECT_NEAR(std::hypot(active_W, electrical.at("reactive_power_var").get<double>()), apparent_VA,
              1e-5 * apparent_VA);
  EXPECT_NEAR(electrical.at("power_factor"), active_W / apparent_VA, 1e-12);
  EXPECT_NEAR(apparent_VA, 0.5 * 10.0 * electrical.at("current_peak_A").get<double>(),
              1e-3 * apparent_VA);
  EXPECT_EQ(electrical.at("voltage_peak_V"), 10.0);
  EXPECT_LE(electrical.at("balance_residual"), 1e-9);
}

TEST(ExampleSceneTest, VibrationAcrossTheSlidingLeavesThePublishedRatio) {
  EXPECT_NEAR(window_ratio("transverse_open_loop"), 0.64264, 1e-4);
  EXPECT_NEAR(
      window_ratio("transverse_open_loop", "--set solver.method=rk4 --set solver.step_s=1e-8"),
      0.64264, 1e-4);
}

/// Amplitude of the motion A, of the normal force alpha; Vc is the speed from which nothing is
/// gained.
TEST(ExampleSceneTest, VibrationNormalToTheSurfaceLeavesTheClosedForm) {
  const double omega = tests::two_pi * 22e3;
  const double amplitude_m = 750.0 / std::hypot(133e6 - 0.02 * omega * omega, 50.0 * omega);
  const double alpha = 0.75e6 * amplitude_m / 3.0;
  const double critical_m_per_s = 0.5 * 0.75 / 0.625 * omega * amplitude_m;
  for (const double speed_m_per_s : {0.0203, 0.087}) {
    EXPECT_NEAR(window_ratio("normal_open_loop",
                             "--set sliding.velocity_m_per_s=" + std::to_string(speed_m_per_s)),
                friction::normal_vibration_ratio(alpha, speed_m_per_s / critical_m_per_s), 1e-6);
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::example_scenes_test
