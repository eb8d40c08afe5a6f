#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "every_scene.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "scene_texts.hpp"

namespace sonoglide::scene_file::echo_test {
namespace {

void expect_same_scene_again(const scene::Scene& scene) {
  const nlohmann::ordered_json echo = to_json(scene);
  const std::string text = to_toml(echo);
  EXPECT_EQ(to_json(read_text(text, "echo")), echo) << text;
}

TEST(EchoTest, IsTheSameSceneAgain) {
  for (const std::string& text : std::vector<std::string>{
           shortest_open_loop, fullest_open_loop, curve_open_loop, bristles_open_loop,
           springs_open_loop, normal_open_loop, profiles_open_loop, transducer_open_loop,
           transducer_closed_loop, shortest_closed_loop, fullest_closed_loop}) {
    expect_same_scene_again(read_text(text, "s"));
  }
  expect_same_scene_again(read_text(fullest_open_loop, "s", {"sliding.profile=[[1, 2]]"}));
  expect_same_scene_again(
      read_text(shortest_open_loop, "s",
                {"drive.frequency_Hz=60e3", "drive.force_amplitude_N=384", "run.start='steady'"}));
  expect_same_scene_again(
      read_text("friction.law = 'none'\n"
                "plant = {mass_kg = 1, stiffness_N_per_m = 2}\n"
                "sliding.profile = [[0, 2]]\nrun.duration_s = 1\n",
                "s"));
}

TEST(EchoTest, OfTheExamplesIsTheSameSceneAgain) {
  for (const auto& entry : std::filesystem::directory_iterator(SONOGLIDE_SCENES)) {
    if (entry.path().extension() == ".toml") {
      expect_same_scene_again(read_file(entry.path()));
    }
  }
}

/// Absent it would follow from the design.
// One velocity of the sliding is velocity_m_per_s; that of a pull has no other key.
TEST(EchoTest, HoldsAPullThatIsConstant) {
  const scene::Scene scene =
      read_text(load_open_loop, "s", {"load.pull_profile_m_per_s=[[0, 0.02]]"});
  EXPECT_EQ(to_json(scene)["load"]["pull_profile_m_per_s"].dump(), "[[0.0,0.02]]");
  expect_same_scene_again(scene);
}

TEST(EchoTest, HoldsACalibrationOf0) {
  const scene::Scene trusting =
      read_file(std::filesystem::path(SONOGLIDE_SCENES) / "damped_by_force.toml",
                {"controller.calibration_s=0"});
  EXPECT_EQ(to_json(trusting).at("controller").at("calibration_s"), 0.0);
  expect_same_scene_again(trusting);
}

TEST(EchoTest, HoldsTheValuesOfTheFile) {
  const nlohmann::ordered_json echo = to_json(read_text(fullest_closed_loop, "s"));
  EXPECT_EQ(echo.at("plant").at("stiffness_N_per_m"), 133e6);
  EXPECT_EQ(echo.at("friction").at("law"), "dahl");
  EXPECT_EQ(echo.at("sliding").at("velocity_m_per_s"), -0.0267);
  EXPECT_EQ(echo.at("drive").at("waveform"), "cosine");
  EXPECT_EQ(echo.at("controller").at("target_friction_ratio").at(1).at(1), 0.6);
  EXPECT_EQ(echo.at("controller").at("shaping"), "robust");
  EXPECT_EQ(echo.at("controller").at("shaping_range"), 0.2);
  EXPECT_EQ(echo.at("sensor").at("adc_bits"), 12);
  EXPECT_EQ(echo.at("sensor").at("seed"), 9223372036854775807);
  EXPECT_EQ(echo.at("model_error").at("contact_stiffness"), 1.5);
}

TEST(EchoTest, KnowsEveryKeyOfTheSchema) {
  std::set<std::string> echoed;
  for (const std::string& text : every_scene()) {
    const nlohmann::ordered_json echo = to_json(read_text(text, "s"));
    for (const auto& [table, values] : echo.items()) {
      for (const auto& [key, value] : values.items()) {
        echoed.insert(table + "." + key);
      }
    }
  }
  // Periods are echoed as seconds.
  echoed.insert("run.duration_periods");
  echoed.insert("run.window_start_periods");
  for (const KeyTable& table : key_tables()) {
    for (const Key& key : table.keys) {
      EXPECT_EQ(echoed.count(fmt::format("{}.{}", table.name, key.name)), 1U)
          << table.name << "." << key.name;
    }
  }
}

/// A number of any magnitude that a key allows, every bit of it random.
double magnitude(double low, double high) {
  const double share =
      *rc::gen::map(rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 53),
                    [](std::int64_t n) { return std::ldexp(static_cast<double>(n), -53); });
  const double value = std::exp(std::log(low) + share * (std::log(high) - std::log(low)));
  return std::min(std::max(value, low), high);
}

TEST(EchoTest, KeepsEveryBitOfEveryNumber) {
  EXPECT_TRUE(rc::check([] {
    nlohmann::ordered_json echo = to_json(read_text(fullest_open_loop, "s"));
    echo["plant"]["mass_kg"] = magnitude(1e-2, 1e6);
    echo["plant"]["stiffness_N_per_m"] = magnitude(1e-300, 1e10);
    echo["plant"]["damping_N_s_per_m"] = magnitude(1e-300, 1e12);
    echo["friction"]["coefficient"] = magnitude(1.0, 100.0);
    echo["friction"]["contact_stiffness_N_per_m"] = magnitude(1e-6, 1e18);
    echo["drive"]["force_amplitude_N"] = magnitude(1e-12, 1e12);
    RC_ASSERT(to_json(read_text(to_toml(echo), "s")) == echo);
  }));
}

TEST(EchoTest, KeepsEveryBitOfAControllersNumbers) {
  EXPECT_TRUE(rc::check([] {
    nlohmann::ordered_json echo = to_json(read_text(fullest_closed_loop, "s"));
    echo["solver"]["tolerance"] = magnitude(1e-15, 1e-2);
    echo["controller"]["target_friction_ratio"][0][1] = magnitude(1e-300, 1.0);
    echo["controller"]["shaping_range"] = magnitude(1e-4, 0.5);
    echo["sensor"]["force_full_scale_N"] = magnitude(0.03, 5.0);  // from 6.6 on too coarse
    echo["sensor"]["force_noise_N"] = magnitude(1e-300, 1.0);
    echo["sensor"]["force_offset_N"] = -magnitude(1e-300, 1e12);
    echo["sensor"]["velocity_gain"] = magnitude(1e-300, 100.0);
    echo["model_error"]["stiffness"] = magnitude(0.01, 10.0);
    RC_ASSERT(to_json(read_text(to_toml(echo), "s")) == echo);
  }));
}

}  // namespace
}  // namespace sonoglide::scene_file::echo_test
