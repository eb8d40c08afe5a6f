#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace sonoglide::acceptance {
namespace {

nlohmann::json run_file(const ScratchFolder& folder, const std::string& file,
                        const Settings& settings) {
  std::string arguments = "run '" + file + "' --out out --quiet";
  for (const std::string& setting : settings) {
    arguments += " --set '" + setting + "'";
  }
  const Outcome outcome = folder.run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0 ? nlohmann::json::parse(folder.read("out/summary.json"))
                                : nlohmann::json();
}

}  // namespace

nlohmann::json run_scene(const ScratchFolder& folder, const std::string& scene,
                         const Settings& settings) {
  return run_file(folder, SONOGLIDE_SCENES "/" + scene + ".toml", settings);
}

nlohmann::json summary_of(const std::string& scene, const Settings& settings) {
  const ScratchFolder folder;
  return run_scene(folder, scene, settings);
}

nlohmann::json summary_of_text(const std::string& text, const Settings& settings) {
  const ScratchFolder folder;
  folder.write("scene.toml", text);
  return run_file(folder, "scene.toml", settings);
}

std::string scene_text(const std::string& scene) {
  std::ifstream file(SONOGLIDE_SCENES "/" + scene + ".toml", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<Step> steps_of(const nlohmann::json& summary) {
  const auto number = [](const nlohmann::json& value) {
    return value.is_null() ? std::nan("") : value.get<double>();
  };
  std::vector<Step> steps;
  if (!summary.is_object()) {
    return steps;
  }
  for (const nlohmann::json& step : summary.at("control").at("steps")) {
    const nlohmann::json& settling = step.at("settling_time_s");
    steps.push_back({step.at("target"),
                     settling.is_null() ? std::optional<double>() : std::optional<double>(settling),
                     number(step.at("overshoot")), number(step.at("steady_error")),
                     number(step.at("ripple")), number(step.at("drive_amplitude_N")),
                     step.at("limit")});
  }
  return steps;
}

void expect_step_within(const Step& step, const Bounds& bounds) {
  const testing::ScopedTrace trace(__FILE__, __LINE__,
                                   testing::Message() << "step to " << step.target);
  EXPECT_TRUE(step.settling_time_s) << "never settles";
  EXPECT_LE(step.settling_time_s.value_or(0.0), bounds.settling_time_s);
  EXPECT_LE(std::abs(step.steady_error), bounds.steady_error);
  EXPECT_LE(step.ripple, bounds.ripple);
  EXPECT_EQ(step.limit, "none");
}

void expect_steps_within(const nlohmann::json& summary, const Bounds& bounds) {
  ASSERT_TRUE(summary.is_object());
  expect_no_fault(summary);
  const std::vector<Step> steps = steps_of(summary);
  EXPECT_FALSE(steps.empty());
  for (const Step& step : steps) {
    expect_step_within(step, bounds);
  }
}

void expect_no_fault(const nlohmann::json& summary) {
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary.at("control").at("faults"), nlohmann::json::array());
}

}  // namespace sonoglide::acceptance
