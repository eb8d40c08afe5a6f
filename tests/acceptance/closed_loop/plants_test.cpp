/// Plants, drives and targets other than those of Table 1.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::acceptance::plants_test {
namespace {

constexpr double period_s = 1.0 / 60e3;
constexpr Bounds ideal{10.001 * period_s, 0.001, 0.002};

/// A change to target_step.toml and what its steps may then do.
struct Variation {
  std::string name;
  Settings settings;
  Bounds bounds;
};

/// With damping as a part of the critical one, 3262 N s/m.
Variation damped(const std::string& name, const std::string& damping) {
  return {"damping_" + name, {"plant.damping_N_s_per_m=" + damping}, ideal};
}

/// With the natural frequency as a part of the carrier's: stiffness 2842.446e6 N/m times its
/// square.
Variation natural_frequency(const std::string& name, double part, double periods) {
  return {"natural_frequency_" + name,
          {"plant.stiffness_N_per_m=" + std::to_string(0.02 * part * part * 142122303375.675)},
          {periods * 1.0001 * period_s, 0.001, 0.002}};
}

/// With the natural mode 0.010 carrier frequencies above twice the carrier, where no notch serves, and a
/// stiffness that is believed to be another.
Variation ramped_beside_a_multiple(const std::string& name, const std::string& believed) {
  return {"ramped_beside_a_multiple_" + name,
          {"plant.stiffness_N_per_m=11.484e9", "drive.max_force_amplitude_N=6000",
           "drive.interpolation=linear", "model_error.stiffness=" + believed},
          {12.0 * period_s, 0.002, 0.005}};
}

const Variation variations[] = {
    ramped_beside_a_multiple("3_percent_softer", "0.97"),
    ramped_beside_a_multiple("3_percent_stiffer", "1.03"),
    damped("0.001", "3.26"),
    damped("0.01", "32.6"),
    damped("0.1", "326"),
    damped("0.3", "979"),
    damped("0.7", "2283"),
    damped("0.99", "3229"),
    damped("1", "3262"),
    damped("3", "9786"),
    natural_frequency("0.08", 0.08, 10),
    natural_frequency("0.25", 0.25, 10),
    natural_frequency("0.5", 0.5, 10),
    natural_frequency("0.75", 0.75, 10),
    natural_frequency("0.9", 0.9, 10),
    natural_frequency("0.95", 0.95, 10),
    natural_frequency("1.2", 1.2, 10),
    natural_frequency("1.5", 1.5, 10),
    natural_frequency("1.9", 1.9, 10),
    // The mass gives way to the mean friction, which the controller does not model.
    {"no_spring",
     {"plant.stiffness_N_per_m=0", "sliding.velocity_m_per_s=0.1",
      "controller.target_friction_ratio=[[0.0,0.5],[2e-3,0.7],[4e-3,0.6]]"},
     ideal},
    // 200 N of friction slow the vibration by as much as it is driven.
    {"heavy_friction",
     {"friction.normal_force_N=2000", "friction.contact_stiffness_N_per_m=1e9"},
     {0.5e-3, 0.001, 0.002}},
    {"light_friction", {"friction.normal_force_N=0.02"}, ideal},
    {"stiff_contact", {"friction.contact_stiffness_N_per_m=1e9"}, ideal},
    {"as_printed", {"friction.sign_convention=as_printed"}, ideal},
    {"backward", {"sliding.velocity_m_per_s=-0.02672"}, ideal},
    {"slow_sliding", {"sliding.velocity_m_per_s=0.008"}, ideal},
    {"strong_actuator", {"drive.max_force_amplitude_N=1e5"}, ideal},
    {"heavy_mass",
     {"plant.mass_kg=0.1", "friction.normal_force_N=0.1962", "drive.max_force_amplitude_N=1e4"},
     ideal},
    {"carrier_20_kHz", {"drive.frequency_Hz=20e3"}, {10.001 / 20e3, 0.001, 0.002}},
    {"high_targets",
     {"controller.target_friction_ratio=[[0.0,0.95],[1e-3,0.99],[2e-3,1.0],[3e-3,0.5],[4e-3,0.9]]"},
     ideal},
    {"low_targets",
     {"controller.target_friction_ratio=[[0.0,0.15],[3e-3,0.12]]"},
     {10.001 * period_s, 0.001, 0.002}},
};

class PlantTest : public testing::TestWithParam<std::tuple<Variation, std::string>> {};

TEST_P(PlantTest, IsControlled) {
  const auto& [variation, arithmetic] = GetParam();
  Settings settings = variation.settings;
  settings.push_back("controller.arithmetic=" + arithmetic);
  expect_steps_within(summary_of("target_step", settings), variation.bounds);
}

std::string identifier(std::string name) {
  for (char& letter : name) {
    letter = letter == '.' ? 'p' : letter;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Variations, PlantTest,
                         testing::Combine(testing::ValuesIn(variations),
                                          testing::ValuesIn(arithmetics)),
                         [](const auto& varied) {
                           return identifier(std::get<0>(varied.param).name + "_" +
                                             std::get<1>(varied.param));
                         });

class ArithmeticTest : public testing::TestWithParam<std::string> {};

TEST_P(ArithmeticTest, CoulombContactIsControlled) {
  std::string text = scene_text("target_step");
  const auto replace = [&text](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("\"dahl\"", "\"coulomb\"");
  replace("contact_stiffness_N_per_m = 0.056e6\n", "");
  const nlohmann::json summary = summary_of_text(text, {"controller.arithmetic=" + GetParam()});
  expect_steps_within(summary, ideal);
  // Coulomb: ρ = (2/π) asin(Vt/v̂), v̂ 0.13914 mm/s for each newton.
  const std::vector<Step> steps = steps_of(summary);
  ASSERT_EQ(steps.size(), 3U);
  for (const Step& step : steps) {
    const double velocity_ratio = std::sin(tests::pi / 2.0 * step.target);
    EXPECT_NEAR(step.drive_amplitude_N * 0.13913955437e-3 * velocity_ratio / 0.02672, 1.0, 0.01);
  }
}

TEST_P(ArithmeticTest, ManySmallStepsAreFollowed) {
  std::string targets;
  for (int i = 0; i < 30; ++i) {
    targets += (i == 0 ? "[" : ",[") + std::to_string(i * 0.2e-3) + "," +
               std::to_string(0.4 + 0.01 * (i % 7)) + "]";
  }
  expect_steps_within(
      summary_of("target_step", {"controller.target_friction_ratio=[" + targets + "]",
                                 "controller.arithmetic=" + GetParam()}),
      ideal);
}

TEST_P(ArithmeticTest, DampedPlantDrivenNearItsResonanceIsControlled) {
  // 1.7 % above 12.979 kHz, one hundredth of critical damping: 20 N are more than enough.
  const nlohmann::json summary =
      summary_of("target_step",
                 {"drive.frequency_Hz=13.2e3", "plant.damping_N_s_per_m=32.6",
                  "drive.max_force_amplitude_N=20",
                  "controller.target_friction_ratio=[[0.0,0.5],[10e-3,0.7],[20e-3,0.6]]",
                  "run.duration_s=30e-3", "run.record=[]", "controller.arithmetic=" + GetParam()});
  expect_steps_within(summary, {2e-3, 0.001, 0.002});
}

INSTANTIATE_TEST_SUITE_P(Arithmetic, ArithmeticTest, testing::ValuesIn(arithmetics),
                         [](const auto& arithmetic) { return arithmetic.param; });

}  // namespace
}  // namespace sonoglide::acceptance::plants_test
