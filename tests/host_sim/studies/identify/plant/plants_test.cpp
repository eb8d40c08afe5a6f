/// Plants at random, as they are found by the readings of 12 bits of a unit that was designed for another.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/studies/identify/plant/plant_problem.hpp"
#include "host_sim/studies/identify/plant/study.hpp"
#include "host_sim/studies/identify/plant/uncertainty.hpp"
#include "tests/common/csv/csv.hpp"
#include "tests/host_sim/studies/identify/plant/commissioned/commissioned.hpp"
#include "tests/host_sim/studies/identify/plant/commissioned/recorded.hpp"

namespace sonoglide::identify::plant::plants_test {
namespace {

csv::Table recorded_plants(const char* file = PLANTS) {
  std::ifstream stream(file);
  return csv::Table(std::string(std::istreambuf_iterator<char>(stream), {}), file);
}

TEST(IdentifiedPlants, SettleAsIfTheirPlantWereKnown) {
  const csv::Table table = recorded_plants();
  double commissioned = 0.0;
  double exact = 0.0;
  for (const csv::Row& row : table.rows()) {
    commissioned += row.number("prompt_commissioned");
    exact += row.number("prompt_exact");
  }
  EXPECT_GE(commissioned, 0.98 * exact);
}

TEST(IdentifiedPlants, AreInsideTheirIntervals) {
  const csv::Table table = recorded_plants();
  std::size_t covered = 0;
  for (const csv::Row& row : table.rows()) {
    for (const char digit : row.text("covered")) {
      covered += digit == '1' ? 1 : 0;
    }
    EXPECT_EQ(row.text("warned"), "0") << row.text("seed");
  }
  EXPECT_GE(static_cast<double>(covered), 0.95 * 3.0 * static_cast<double>(table.rows().size()));
}

/// Or their spring is left open.
TEST(IdentifiedPlants, AreInsideTheirIntervalsInNoise) {
  const csv::Table table = recorded_plants(NOISY_PLANTS);
  std::size_t wrong = 0;
  std::size_t covered = 0;
  for (const csv::Row& row : table.rows()) {
    wrong += row.text("covered") == "0" ? 1 : 0;
    covered += row.text("covered") == "1" ? 1 : 0;
  }
  EXPECT_GE(covered, 50U);
  EXPECT_LE(static_cast<double>(wrong), 0.05 * static_cast<double>(table.rows().size()));
}

TEST(IdentifiedPlants, OneIsAsRecorded) {
  const csv::Table table = recorded_plants();
  constexpr std::uint64_t seed = 2;
  const csv::Row& row = table.rows().at(seed);
  const test::Commissioned found = test::commissioned(SCENES "target_step.toml", seed);
  EXPECT_NEAR(found.truth[0], row.number("stiffness"), 1e-5);
  EXPECT_NEAR(found.error[0], row.number("stiffness_error"), 1e-4);
  EXPECT_NEAR(found.error[1], row.number("coefficient_error"), 1e-3);
  EXPECT_NEAR(found.error[2], row.number("contact_stiffness_error"), 1e-2);
  EXPECT_EQ(found.commissioned, row.number("prompt_commissioned"));
}

struct FullForceCase {
  double mass_kg;
  double force_N;
};

class AnotherFullForce : public testing::TestWithParam<FullForceCase> {};

/// No spring and no damper of the scene's mass makes up for it.
TEST_P(AnotherFullForce, IsFittedWhateverOfForceAndMassIsOff) {
  const auto [mass_kg, force_N] = GetParam();
  const configure::Experiment scene = experiment::read_file(
      SCENES "target_step.toml",
      {"sensor.adc_bits=12", fmt::format("true_values.plant.mass_kg={}", mass_kg),
       fmt::format("true_values.drive.max_force_amplitude_N={}", force_N)});
  const double factor = mass_kg / scene.nominal.plant.mass_kg;
  const PlantStudy found =
      study(scene, test::recorded(scene, targets(scene.nominal), 256, 32), [](double) {});
  const Identification& told = found.fit.identification;
  const auto value = [&](const std::string& key) {
    return std::find_if(told.parameters.begin(), told.parameters.end(),
                        [&](const Estimate& each) { return each.name == key; })
        ->value;
  };
  EXPECT_NEAR(value("drive.max_force_amplitude_N"), force_N / factor, 4.0);
  EXPECT_NEAR(value("plant.stiffness_N_per_m"), 133e6 / factor, 133e6 * 1e-3);
  EXPECT_TRUE(told.warnings.empty()) << told.warnings.front();
  EXPECT_EQ(
      told.cannot_tell.front().rfind(
          "drive.max_force_amplitude_N: whether the force or plant.mass_kg differs from the scene.",
          0),
      0U);
  for (const StepComparison& each : found.steps) {
    EXPECT_LT(each.commissioned.settling_time_s.value_or(1.0), 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, AnotherFullForce,
                         testing::Values(FullForceCase{0.021, 1824.0},
                                         FullForceCase{0.0202, 1920.0}));

/// Of a unit whose force and bias are so many times those of the scene, with the true force fitted.
double rms_of_residuals(double force, double bias) {
  configure::Experiment scene = experiment::read_file(
      SLOW_MODE, {fmt::format("true_values.drive.max_force_amplitude_N={}", force * 2200.0),
                  "true_values.plant.damping_N_s_per_m=0.4524"});
  scene.plant.drive->bias_limit_N *= bias;
  const std::vector<Stretch> stretches = test::recorded(scene, {0.9, 0.4}, 128, 32);
  const PlantProblem problem(scene, stretches, FullForce::fitted);
  Eigen::VectorXd parameters = problem.start();
  parameters(problem.index_of(force_key)) += std::log(force);
  const Eigen::VectorXd residuals = problem.residuals(parameters, PlantProblem::all_steps);
  const double expected = plant::expected(scene.nominal.sensor).deviation();
  return std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size())) / expected;
}

/// One actuator drives both.
TEST(IdentifiedPlants, ABiasIsOffByTheFactorOfTheForce) {
  EXPECT_LT(rms_of_residuals(0.9, 0.9), 1.5);
  EXPECT_GT(rms_of_residuals(0.9, 1.0), 3.0);
}

PlantStudy found_in_noise(const std::vector<std::string>& sensor) {
  const configure::Experiment scene = experiment::read_file(SCENES "noisy_sensor.toml", sensor);
  return study(scene, test::recorded(scene, targets(scene.nominal), 1024, 32), [](double) {});
}

/// Noise hides the natural mode: many springs are possible, and the interval has them.
TEST(IdentifiedPlants, WhatNoiseHidesIsNotToldTightly) {
  const PlantStudy found = found_in_noise({"sensor.seed=4"});
  const Estimate& spring = found.fit.identification.parameters.front();
  EXPECT_EQ(spring.name, "plant.stiffness_N_per_m");
  EXPECT_LT(spring.low_95, 133e6);
  EXPECT_GT(spring.high_95, 133e6);
  EXPECT_TRUE(found.fit.changed.empty());
  // Another spring may give the same levels: that is said.
  const std::string& open = found.fit.identification.cannot_tell.front();
  EXPECT_EQ(
      open,
      "plant.stiffness_N_per_m: the natural mode does not stand out of the noise, so springs from 0.62 to 1.6 "
      "times the scene's were tried. The interval contains all of them that fit these readings. One farther "
      "away may fit too, as on the other side of the carrier frequency.");
}

/// At 5 and 6 bits springs were fitted that were 14 % off, with intervals of 0.1 %.
TEST(IdentifiedPlants, AConverterThatIsTooCoarseIsNoSourceOfNoise) {
  scene::Sensor sensor = experiment::read_file(SCENES "target_step.toml").nominal.sensor;
  const auto is_coarse = [&](int bits) {
    sensor.adc_bits = bits;
    return plant::expected(sensor).rounds_coarsely(0.5);
  };
  EXPECT_TRUE(is_coarse(5) && is_coarse(6) && is_coarse(7));
  EXPECT_FALSE(is_coarse(8));
  sensor.force_noise_N = sensor.force_full_scale_N * std::ldexp(1.0, -5);
  EXPECT_FALSE(is_coarse(5)) << "noise stirs the codes";
}

TEST(IdentifiedPlants, AConverterThatIsTooCoarseChangesNoSpring) {
  const configure::Experiment scene =
      experiment::read_file(SCENES "target_step.toml", {"sensor.adc_bits=5"});
  const PlantFit fit =
      study(scene, test::recorded(scene, targets(scene.nominal), 1024, 32), [](double) {}).fit;
  const auto& warnings = fit.identification.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& each) {
    return each.find("The converter shows the undriven friction in 8 codes") == 0;
  }));
  for (const auto& [key, value] : fit.changed) {
    EXPECT_NE(key, "plant.stiffness_N_per_m") << value;
    EXPECT_NE(key, "plant.damping_N_s_per_m") << value;
  }
}

/// With ten times the noise springs 50 % away fit as well: none is told.
TEST(IdentifiedPlants, ASpringThatNoiseLeavesOpenStaysThatOfTheScene) {
  const PlantStudy found = found_in_noise({"sensor.seed=4", "sensor.force_noise_N=1e-3"});
  const Estimate& spring = found.fit.identification.parameters.front();
  EXPECT_EQ(spring.name, "plant.stiffness_N_per_m");
  EXPECT_TRUE(std::isnan(spring.value) && std::isnan(spring.low_95) && std::isnan(spring.high_95));
  EXPECT_TRUE(found.fit.changed.empty());
  const std::string& open = found.fit.identification.cannot_tell.front();
  EXPECT_EQ(
      open.find(
          "plant.stiffness_N_per_m: the natural mode does not stand out of noise and rounding, and springs from 0.6"),
      0U)
      << open;
  EXPECT_NE(found.scene.find("# The readings cannot tell: " + open), std::string::npos);
  EXPECT_EQ(experiment::read_text(found.scene, "commissioned.toml").nominal.plant.stiffness_N_per_m,
            133e6);
}

}  // namespace
}  // namespace sonoglide::identify::plant::plants_test
