#include <gtest/gtest.h>

#include <string>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"

namespace sonoglide::acceptance::drive_amplitude_test {
namespace {

/// The drive that holds a friction ratio at a sliding velocity, from the inverse of the closed-form
/// map.
struct Point {
  const char* velocity_m_per_s;
  const char* target;
  double drive_N;
};

class DriveAmplitudeTest : public testing::TestWithParam<std::string> {};

TEST_P(DriveAmplitudeTest, IsThatOfTheInverseMap) {
  for (const Point& point : {Point{"0.02672", "0.3", 818.6}, Point{"0.02672", "0.5", 526.3},
                             Point{"0.02672", "0.7", 367.9}, Point{"0.1", "0.5", 1512.0}}) {
    const std::vector<Step> steps = steps_of(
        summary_of("target_step",
                   {std::string("sliding.velocity_m_per_s=") + point.velocity_m_per_s,
                    std::string("controller.target_friction_ratio=[[0.0,") + point.target + "]]",
                    "run.duration_s=2e-3", "controller.arithmetic=" + GetParam()}));
    ASSERT_EQ(steps.size(), 1U);
    EXPECT_NEAR(steps[0].drive_amplitude_N / point.drive_N, 1.0, 0.01) << point.target;
    EXPECT_LE(std::abs(steps[0].steady_error), 0.001);
  }
}

INSTANTIATE_TEST_SUITE_P(Arithmetic, DriveAmplitudeTest, testing::ValuesIn(arithmetics),
                         [](const auto& arithmetic) { return arithmetic.param; });

}  // namespace
}  // namespace sonoglide::acceptance::drive_amplitude_test
