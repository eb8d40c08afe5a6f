#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance {
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
  EXPECT_EQ(summary.at("scene").at("plant").at("mass_kg"), 0.02);
  const bool open_loop = GetParam().find("open_loop") != std::string::npos;
  EXPECT_EQ(summary.at("scene").contains("controller"), !open_loop);
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

}  // namespace
}  // namespace sonoglide::acceptance
