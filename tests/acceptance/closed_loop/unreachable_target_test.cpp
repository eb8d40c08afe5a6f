#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::acceptance::unreachable_target_test {
namespace {

constexpr double period_s = 1.0 / 60e3;
constexpr double step_time_s = 2e-3;
constexpr double limit_N = 1920.0;

class UnreachableTargetTest : public testing::TestWithParam<std::string> {
 protected:
  Settings with(Settings settings) const {
    settings.push_back("controller.arithmetic=" + GetParam());
    return settings;
  }
};

TEST_P(UnreachableTargetTest, SaturatesAndSaysSo) {
  const nlohmann::json summary = summary_of("unreachable_target", with({}));
  expect_no_fault(summary);
  const std::vector<Step> steps = steps_of(summary);
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[1].limit, "actuator");
  EXPECT_FALSE(steps[1].settling_time_s);
  EXPECT_NEAR(steps[1].drive_amplitude_N, limit_N, 1e-5);
  // What full drive gives: the closed-form map at Vt/v̂ = 0.37433, κ = 2.0225.
  EXPECT_NEAR(steps[1].steady_error, 0.35082 - 0.2, 0.002);
  EXPECT_NEAR(summary.at("control").at("saturated_fraction").get<double>(), 1.0 / 3.0, 0.01);
}

TEST_P(UnreachableTargetTest, IsAtTheLimitThreePeriodsAfterTheStep) {
  const ScratchFolder folder;
  run_scene(folder, "unreachable_target", with({}));
  const csv::Table trace(folder.read("out/trace.csv"));
  EXPECT_EQ(trace.columns(), (csv::Cells{"time_s", "friction_force_N", "drive_force_N"}));
  ASSERT_EQ(trace.rows().size(), 6001U);
  int checked = 0;
  for (const csv::Row& row : trace.rows()) {
    const double time_s = row.number("time_s");
    const double since_s = time_s - step_time_s;
    if (since_s >= 3.0 * period_s + 1e-9 && since_s < 2e-3 - 1e-9) {
      const double phase = std::fmod(time_s / period_s, 1.0);
      ASSERT_NEAR(row.number("drive_force_N"), limit_N * std::cos(tests::two_pi * phase), 1e-3)
          << time_s;
      ++checked;
    }
  }
  EXPECT_NEAR(checked, (2e-3 - 3.0 * period_s) / 1e-6, 2.0);
}

TEST_P(UnreachableTargetTest, DoesNotWindUp) {
  const std::vector<Step> after = steps_of(summary_of("unreachable_target", with({})));
  const std::vector<Step> fresh = steps_of(
      summary_of("unreachable_target",
                 with({"controller.target_friction_ratio=[[0.0,0.6]]", "run.duration_s=2e-3"})));
  ASSERT_EQ(after.size(), 3U);
  ASSERT_EQ(fresh.size(), 1U);
  ASSERT_TRUE(after[2].settling_time_s);
  ASSERT_TRUE(fresh[0].settling_time_s);
  EXPECT_LE(*after[2].settling_time_s, *fresh[0].settling_time_s + 1e-9);
  expect_step_within(after[2], {10.001 * period_s, 0.001, 0.002});
  EXPECT_LE(after[2].overshoot, 0.005);
}

TEST_P(UnreachableTargetTest, DoesNotWindUpHoweverLongItStands) {
  const std::vector<Step> steps = steps_of(
      summary_of("unreachable_target",
                 with({"controller.target_friction_ratio=[[0.0,0.5],[2e-3,0.05],[52e-3,0.6]]",
                       "run.duration_s=54e-3", "run.record=[]"})));
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[1].limit, "actuator");
  expect_step_within(steps[2], {10.001 * period_s, 0.001, 0.002});
}

INSTANTIATE_TEST_SUITE_P(Arithmetic, UnreachableTargetTest, testing::ValuesIn(arithmetics),
                         [](const auto& arithmetic) { return arithmetic.param; });

TEST(ActuatorLimitTest, OfAWeakActuatorHoldsOnlyWhereItMust) {
  const std::vector<Step> steps =
      steps_of(summary_of("target_step", {"drive.max_force_amplitude_N=600"}));
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[0].limit, "actuator");  // needs 645 N
  expect_step_within(steps[1], {10.001 * period_s, 0.001, 0.002});
  expect_step_within(steps[2], {10.001 * period_s, 0.001, 0.002});
}

TEST(VelocityAtRailTest, IsNamedWhereSlidingOutrunsTheVibration) {
  for (const char* velocity : {"0.3", "-1.0"}) {
    const nlohmann::json summary =
        summary_of("target_step", {std::string("sliding.velocity_m_per_s=") + velocity});
    expect_no_fault(summary);
    for (const Step& step : steps_of(summary)) {
      EXPECT_EQ(step.limit, "velocity_at_rail");
      EXPECT_NEAR(step.steady_error, 1.0 - step.target, 1e-6);
      EXPECT_EQ(step.drive_amplitude_N, 0.0);
    }
  }
}

TEST(SlewLimitTest, IsNamedWhileItHoldsAndSettlesWhenItIsOver) {
  const std::vector<Step> slow =
      steps_of(summary_of("target_step", {"drive.max_force_slew_N_per_s=1e5"}));
  ASSERT_EQ(slow.size(), 3U);
  EXPECT_EQ(slow[0].limit, "slew");
  EXPECT_EQ(slow[1].limit, "slew");
  // 645 N at 1e6 N/s, behind taps that add up to 1.53.
  expect_steps_within(summary_of("target_step", {"drive.max_force_slew_N_per_s=1e6"}),
                      {1.1e-3, 0.001, 0.002});
}

}  // namespace
}  // namespace sonoglide::acceptance::unreachable_target_test
