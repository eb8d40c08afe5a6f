// Controllers that are fed forward by the map of the scene's own law: without feedback in friction ratio the
// ratio is on its target, and with it the loop settles as one under the Dahl law does.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "measured_run.hpp"
#include "tests/common/constants/table_1_numbers.hpp"

namespace sonoglide::own_maps_test {
namespace {

using tests::Table1;

struct Law {
  const char* name;
  const char* keys;     ///< of [friction]
  const char* targets;  ///< that it reaches
};

/// At the mass and the drive of Table 1, which vibrates ten times as fast as the sliding at full drive, by
/// 0.7 um.
const std::array<Law, 5> laws = {
    {{"lugre",
      "contact_stiffness_N_per_m = 0.2e6\nstatic_coefficient = 0.13\n"
      "stribeck_velocity_m_per_s = 0.02\nbristle_damping_N_s_per_m = 0.005\n"
      "viscous_friction_N_s_per_m = 0.02\n",
      "[[0.0, 0.5], [2e-3, 0.8], [4e-3, 0.3]]"},
     {"iwan", "contact_stiffness_N_per_m = 0.05e6\nelements = 4\n",
      "[[0.0, 0.5], [2e-3, 0.8], [4e-3, 0.4]]"},
     {"stribeck", "fall_s_per_m = 0.8\nrise_s3_per_m3 = 20\n",
      "[[0.0, 0.5], [2e-3, 0.8], [4e-3, 0.3]]"},
     {"transverse_coulomb", "", "[[0.0, 0.5], [2e-3, 0.9], [4e-3, 0.4]]"},
     {"normal_coulomb",
      "contact_stiffness_N_per_m = 0.05e6\nnormal_contact_stiffness_N_per_m = 0.25e6\n",
      "[[0.0, 0.7], [2e-3, 0.9], [4e-3, 0.6]]"}}};

acceptance::MeasuredRun run(const Law& law, const std::string& controller,
                            const std::string& sensor) {
  const std::string text = fmt::format(
      "[plant]\nmass_kg = {}\nstiffness_N_per_m = {}\n"
      "[friction]\nlaw = \"{}\"\ncoefficient = 0.1\n{}"
      "[sliding]\nvelocity_m_per_s = 0.0267\n"
      "[drive]\nfrequency_Hz = 60e3\nmax_force_amplitude_N = 1920.0\n"
      "[run]\nduration_s = 6e-3\n"
      "[controller]\n{}\ntarget_friction_ratio = {}\n"
      "[sensor]\n{}\n",
      Table1::mass_kg, Table1::stiffness_N_per_m, law.name, law.keys, controller, law.targets,
      sensor);
  return acceptance::run_measured(experiment::read_text(text, "own_maps.toml").plant);
}

class OwnMapsTest : public testing::TestWithParam<Law> {};

// The friction is believed right: what is left is the error of the table, of the closed form, and of a
// vibration that is not quite a sine.
TEST_P(OwnMapsTest, BringTheRatioToItsTargetWithoutFeedback) {
  for (const char* arithmetic : {"float64", "float32", "q31"}) {
    const auto ran =
        run(GetParam(), fmt::format("arithmetic = \"{}\"\nvibration = \"damped\"", arithmetic),
            "vibration = \"velocity\"\nforce = false");
    for (const report::StepMetrics& step : ran.steps) {
      EXPECT_LE(std::abs(step.steady_error), 0.008) << arithmetic << ' ' << step.target;
      EXPECT_TRUE(step.settling_time_s) << arithmetic << ' ' << step.target;
    }
  }
}

TEST_P(OwnMapsTest, LetTheLoopSettleWithinHalfAMillisecond) {
  for (const char* arithmetic : {"float64", "float32", "q31", "q15"}) {
    const auto ran = run(GetParam(), fmt::format("arithmetic = \"{}\"", arithmetic), "");
    for (const report::StepMetrics& step : ran.steps) {
      ASSERT_TRUE(step.settling_time_s) << arithmetic << ' ' << step.target;
      EXPECT_LE(*step.settling_time_s, 0.5e-3) << arithmetic << ' ' << step.target;
      EXPECT_LE(std::abs(step.steady_error), 0.002) << arithmetic << ' ' << step.target;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, OwnMapsTest, testing::ValuesIn(laws),
                         [](const testing::TestParamInfo<Law>& each) {
                           return std::string(each.param.name);
                         });

}  // namespace
}  // namespace sonoglide::own_maps_test
