/// A controller that is wrong about its plant, and a sensor that is not ideal.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"

namespace sonoglide::acceptance::imperfect_loop_test {
namespace {

/// Believed over true, of stiffness, coefficient and contact stiffness; arithmetic.
using Corner = std::tuple<std::string, std::string, std::string, std::string>;

class ModelErrorTest : public testing::TestWithParam<Corner> {};

TEST_P(ModelErrorTest, SettlesInAMillisecond) {
  const auto& [stiffness, coefficient, contact_stiffness, arithmetic] = GetParam();
  const nlohmann::json summary =
      summary_of("model_error",
                 {"model_error.stiffness=" + stiffness, "model_error.coefficient=" + coefficient,
                  "model_error.contact_stiffness=" + contact_stiffness,
                  "controller.arithmetic=" + arithmetic, "run.settling_band=0.02"});
  expect_steps_within(summary, {1e-3, 0.002, 0.015});
}

INSTANTIATE_TEST_SUITE_P(Corners, ModelErrorTest,
                         testing::Combine(testing::Values("0.96", "1.04"),
                                          testing::Values("0.7", "1.3"),
                                          testing::Values("0.5", "1.5"),
                                          testing::ValuesIn(arithmetics)));

/// True over believed stiffness; arithmetic.
using WrongMode = std::tuple<double, std::string>;

class RobustNotchTest : public testing::TestWithParam<WrongMode> {};

/// What five taps at Table 1, for a natural frequency that is up to a tenth off, leave of a step: the
/// product of the distances of cos θ from the two zeros, of that at rest.
double left_by_five_taps(double stiffness) {
  const double nominal = std::sqrt(133e6 / 0.02) / 60e3;
  const double low = std::cos(1.1 * nominal);
  const double high = std::cos(0.9 * nominal);
  const double middle = 0.5 * (high + low);
  const double half = 0.5 * (high - low);
  const auto product = [&](double cosine) {
    return (cosine - middle) * (cosine - middle) - 0.5 * half * half;
  };
  return std::abs(product(std::cos(nominal * std::sqrt(stiffness)))) / product(1.0);
}

// Without a notch the ripple is all of the ringing. A little more ripple is there without any.
TEST_P(RobustNotchTest, LeavesThePartOfTheRingingThatItsTapsSay) {
  const auto& [stiffness, arithmetic] = GetParam();
  const Settings wrong = {"model_error.stiffness=" + std::to_string(1.0 / stiffness),
                          "controller.arithmetic=" + arithmetic};
  Settings unshaped = wrong;
  unshaped.insert(unshaped.end(), {"controller.shaping=\"none\"", "controller.shaping_range="});
  const nlohmann::json summary = summary_of("robust_notch", wrong);
  expect_steps_within(summary, {12.001 / 60e3, 0.0005, 0.005});
  const std::vector<Step> shaped = steps_of(summary);
  const std::vector<Step> ringing = steps_of(summary_of("robust_notch", unshaped));
  ASSERT_EQ(shaped.size(), 3U);
  ASSERT_EQ(ringing.size(), 3U);
  for (std::size_t i = 0; i < shaped.size(); ++i) {
    constexpr double without_ringing = 0.0005;
    EXPECT_GT(ringing[i].ripple, 0.2);
    EXPECT_LT(shaped[i].ripple, left_by_five_taps(stiffness) * ringing[i].ripple + without_ringing);
  }
}

INSTANTIATE_TEST_SUITE_P(Stiffness, RobustNotchTest,
                         testing::Combine(testing::Values(0.8, 0.9, 1.0, 1.1, 1.2),
                                          testing::Values("float64", "float32", "q31", "q15")));

class NoisySensorTest : public testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(NoisySensorTest, SettlesInTwoMilliseconds) {
  const auto& [arithmetic, seed] = GetParam();
  const nlohmann::json summary =
      summary_of("noisy_sensor",
                 {"controller.arithmetic=" + arithmetic, "sensor.seed=" + std::to_string(seed)});
  expect_steps_within(summary, {2e-3, 0.005, 0.02});
}

INSTANTIATE_TEST_SUITE_P(Seeds, NoisySensorTest,
                         testing::Combine(testing::ValuesIn(arithmetics), testing::Range(1, 9)));

/// An imperfection of the sensor and what it may cost.
struct Imperfection {
  std::string name;
  Settings settings;
  Bounds bounds;
};

constexpr double ten_periods_s = 10.001 / 60e3;
const std::string long_steps =
    "controller.target_friction_ratio=[[0.0,0.4],[10e-3,0.6],[20e-3,0.5]]";

const Imperfection imperfections[] = {
    {"delay_1", {"sensor.delay_periods=1"}, {ten_periods_s, 0.001, 0.002}},
    {"delay_2", {"sensor.delay_periods=2"}, {ten_periods_s, 0.001, 0.002}},
    {"delay_4", {"sensor.delay_periods=4"}, {ten_periods_s, 0.001, 0.002}},
    {"delay_8", {"sensor.delay_periods=8"}, {ten_periods_s, 0.001, 0.002}},
    {"delay_64", {"sensor.delay_periods=64"}, {ten_periods_s, 0.001, 0.002}},
    {"bits_12", {"sensor.adc_bits=12"}, {ten_periods_s, 0.001, 0.002}},
    // A step of the converter is 0.016 in friction ratio.
    {"bits_8", {"sensor.adc_bits=8"}, {ten_periods_s, 0.004, 0.004}},
    {"bandwidth_2_kHz",
     {"sensor.force_bandwidth_Hz=2e3", "run.duration_s=30e-3", "run.record=[]", long_steps},
     {ten_periods_s, 0.001, 0.002}},
    {"bandwidth_500_Hz",
     {"sensor.force_bandwidth_Hz=500", "run.duration_s=30e-3", "run.record=[]", long_steps},
     {ten_periods_s, 0.001, 0.002}},
    {"bandwidth_100_Hz",
     {"sensor.force_bandwidth_Hz=100", "run.duration_s=30e-3", "run.record=[]", long_steps},
     {ten_periods_s, 0.003, 0.002}},
};

class ImperfectSensorTest : public testing::TestWithParam<std::tuple<Imperfection, std::string>> {};

TEST_P(ImperfectSensorTest, CostsLittleWhereTheModelIsExact) {
  const auto& [imperfection, arithmetic] = GetParam();
  Settings settings = imperfection.settings;
  settings.push_back("controller.arithmetic=" + arithmetic);
  expect_steps_within(summary_of("target_step", settings), imperfection.bounds);
}

INSTANTIATE_TEST_SUITE_P(Sensors, ImperfectSensorTest,
                         testing::Combine(testing::ValuesIn(imperfections),
                                          testing::ValuesIn(arithmetics)),
                         [](const auto& varied) {
                           return std::get<0>(varied.param).name + "_" + std::get<1>(varied.param);
                         });

/// Half a millisecond of calibration is 1.6 time constants of this sensor: too short for it.
TEST(CalibrationTest, OfSixTimeConstantsIsEnoughForASlowSensor) {
  const nlohmann::json summary = summary_of(
      "target_step",
      {"sensor.force_bandwidth_Hz=500", "controller.calibration_s=4e-3", "run.duration_s=34e-3",
       "run.record=[]", "controller.target_friction_ratio=[[0.0,0.4],[14e-3,0.6],[24e-3,0.5]]"});
  expect_steps_within(summary, {ten_periods_s, 0.002, 0.002});
}

}  // namespace
}  // namespace sonoglide::acceptance::imperfect_loop_test
