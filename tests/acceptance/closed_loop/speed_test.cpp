/// Sliding that speeds up, slows down, stops and turns round.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"

namespace sonoglide::acceptance::speed_test {
namespace {

double tracking_error(const nlohmann::json& summary) {
  expect_no_fault(summary);
  return summary.at("control").at("largest_tracking_error").get<double>();
}

class SpeedTest : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

// A drive that answers in a period of its own cannot foresee where a ramp begins: for three periods
// the speed of speed_ramp then rises by 7.5 % each.
TEST_P(SpeedTest, IsFollowedClosely) {
  const auto& [scene, arithmetic] = GetParam();
  const nlohmann::json summary = summary_of(scene, {"controller.arithmetic=" + arithmetic});
  EXPECT_LE(tracking_error(summary), scene == "speed_ramp" ? 0.04 : 0.02);
  EXPECT_LE(tracking_error(summary_of(
                scene, {"controller.arithmetic=" + arithmetic, "drive.delay_periods=0"})),
            0.02);
  EXPECT_NEAR(summary.at("control").at("speed_floor_m_per_s").get<double>(), 0.0070071, 1e-6);
  const Step step = steps_of(summary).at(0);
  EXPECT_TRUE(step.settling_time_s);
  EXPECT_LE(std::abs(step.steady_error), 0.001);
  EXPECT_EQ(step.limit, "none");
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, SpeedTest,
    testing::Combine(testing::Values("speed_ramp", "stop_and_start", "speed_reversal"),
                     testing::ValuesIn(arithmetics)),
    [](const auto& varied) { return std::get<0>(varied.param) + "_" + std::get<1>(varied.param); });

/// A reversal from 26.72 mm/s to as much the other way in the given time.
Settings reversal(double duration_ms) {
  const std::string end_s = std::to_string(2e-3 + 1e-3 * duration_ms);
  return {"sliding.profile=[[0,0.02672],[2e-3,0.02672],[" + end_s + ",-0.02672]]",
          "run.duration_s=" + std::to_string(4e-3 + 1e-3 * duration_ms)};
}

TEST(SpeedReversalTest, IsFollowedTheCloserTheSlowerItIs) {
  EXPECT_LE(tracking_error(summary_of("speed_reversal", reversal(16.0))), 0.01);
  EXPECT_LE(tracking_error(summary_of("speed_reversal", reversal(8.0))), 0.015);
  EXPECT_LE(tracking_error(summary_of("speed_reversal", reversal(2.0))), 0.06);
  EXPECT_LE(tracking_error(summary_of("speed_reversal", reversal(1.0))), 0.11);
}

TEST(SpeedReversalTest, SettlesAgainHoweverFastItWas) {
  for (const double duration_ms : {0.1, 0.2, 0.5, 1.0, 2.0}) {
    const nlohmann::json summary = summary_of("speed_reversal", reversal(duration_ms));
    expect_no_fault(summary);
    const Step step = steps_of(summary).at(0);
    ASSERT_TRUE(step.settling_time_s) << duration_ms;
    EXPECT_LE(*step.settling_time_s, 2e-3 + 1e-3 * duration_ms + 0.27e-3) << duration_ms;
    EXPECT_LE(std::abs(step.steady_error), 0.001);
  }
}

TEST(SpeedReversalTest, IsFollowedWithAnImperfectSensorToo) {
  EXPECT_LE(tracking_error(summary_of("speed_reversal", {"sensor.delay_periods=4"})), 0.02);
  EXPECT_LE(tracking_error(
                summary_of("speed_reversal", {"sensor.adc_bits=12", "sensor.force_noise_N=1e-4",
                                              "sensor.force_bandwidth_Hz=5e3"})),
            0.02);
}

TEST(SpeedTest, StandingStillIsALimitWithAName) {
  const nlohmann::json summary =
      summary_of("stop_and_start", {"sliding.profile=[[0,0.02672],[2e-3,0.02672],[4e-3,0]]"});
  expect_no_fault(summary);
  EXPECT_EQ(steps_of(summary).at(0).limit, "speed_floor");
}

TEST(SpeedTest, CalibrationWaitsForSliding) {
  const nlohmann::json summary =
      summary_of("stop_and_start", {"sliding.profile=[[0,0],[1e-3,0],[2e-3,0.02672]]",
                                    "run.duration_s=6e-3", "controller.calibration_s=0.5e-3"});
  expect_no_fault(summary);
  const Step step = steps_of(summary).at(0);
  EXPECT_TRUE(step.settling_time_s);
  EXPECT_LE(std::abs(step.steady_error), 0.001);
}

class SlowRampTest : public testing::TestWithParam<int> {};

TEST_P(SlowRampTest, ASteadyReadingUnderAMovingDriveIsNoFault) {
  // The drive follows the speed so well that the friction, and with it the reading of a converter,
  // stands still: that is success, not a dead sensor.
  const nlohmann::json summary =
      summary_of("speed_ramp", {"sliding.profile=[[0,0.02],[50e-3,0.12]]", "run.duration_s=50e-3",
                                "run.record=[]", "sensor.adc_bits=" + std::to_string(GetParam())});
  EXPECT_LE(tracking_error(summary), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Converters, SlowRampTest, testing::Values(8, 10, 12));

}  // namespace
}  // namespace sonoglide::acceptance::speed_test
