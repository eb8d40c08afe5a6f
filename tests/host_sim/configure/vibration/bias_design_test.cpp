/// The gain of the bias against the loop that it closes, period by period.
#include "host_sim/configure/vibration/bias_design.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::configure::bias_design_test {
namespace {

using tests::two_pi;

/// What is left of a free motion of an undamped oscillator, per carrier period in the long run, where
/// the mean velocity v̄ of each period is answered by -g v̄ that is in force delay + 1 periods later; mass
/// and period are 1.
double growth(double natural, double part, int delay) {
  const double w = two_pi * natural;
  double x = 0.0;
  double v = 1.0;
  std::vector<double> answers(static_cast<std::size_t>(delay) + 1, 0.0);
  constexpr int periods = 60000;
  double logarithm = 0.0;
  for (int k = 0; k < periods; ++k) {
    const double b = answers.front();
    const double rest = b / (w * w);
    const double next = rest + (x - rest) * std::cos(w) + v / w * std::sin(w);
    v = v * std::cos(w) - w * (x - rest) * std::sin(w);
    answers.erase(answers.begin());
    answers.push_back(-part * (next - x));
    x = next;
    // Scaled down again and again: the motion is linear.
    double size = std::abs(x) * w + std::abs(v);
    for (const double each : answers) {
      size += std::abs(each);
    }
    logarithm += k < periods / 2 ? 0.0 : std::log(size);
    x /= size;
    v /= size;
    for (double& each : answers) {
      each /= size;
    }
  }
  return std::exp(logarithm / (periods - periods / 2));
}

TEST(BiasDesignTest, TheLargestPartIsWhereTheLoopBeginsToGrow) {
  for (const int delay : {0, 1, 2, 5, 16}) {
    for (const double of_edge : {0.02, 0.3, 0.7}) {
      const double natural = of_edge * fastest_biased_mode(delay);
      const double largest = largest_bias_part(natural, delay);
      ASSERT_GT(largest, 0.0) << natural << " " << delay;
      EXPECT_LT(growth(natural, 0.98 * largest, delay), 1.0) << natural << " " << delay;
      EXPECT_GT(growth(natural, 1.02 * largest, delay), 1.0) << natural << " " << delay;
    }
    EXPECT_LE(largest_bias_part(1.0001 * fastest_biased_mode(delay), delay), 0.0);
  }
}

/// Of a mass without a spring: 2 tan(π/8) with a delay of one period. A loop that answered the velocity at
/// the begin of the period, z³ - z² + g, would be stable to (√5 - 1)/2.
TEST(BiasDesignTest, TheLargestPartOfAFreeMass) {
  EXPECT_NEAR(largest_bias_part(1e-4, 0), 2.0, 1e-5);
  EXPECT_NEAR(largest_bias_part(1e-4, 1), 2.0 * std::tan(tests::pi / 8.0), 1e-5);
  EXPECT_GT(largest_bias_part(1e-4, 1), 0.5 * (std::sqrt(5.0) - 1.0));
}

scene::Scene biased(double natural, int delay, bool seen) {
  scene::Scene scene = tests::with_natural_frequency(natural);
  scene.controller->vibration = scene::VibrationControl::damped;
  scene.controller->shaping.reset();
  scene.drive->delay_periods = delay;
  scene.drive->bias_limit_N = 2.0;
  if (seen) {
    scene.sensor.vibration = scene::VibrationSensor::velocity;
  }
  return scene;
}

TEST(BiasDesignTest, IsStableForTheDelayOfTheLoopAndAStiffnessThatIsOff) {
  for (const int delay : {0, 1, 2, 4}) {
    for (const double natural : {0.003, 0.02, 0.04}) {
      const auto design = design_control(biased(natural, delay, true));
      ASSERT_TRUE(design.bias);
      for (const double off : {0.97, 1.0, 1.03}) {
        EXPECT_LT(growth(off * natural, design.bias->part, delay), 1.0) << natural << " " << delay;
      }
      if (delay == 1) {
        EXPECT_NEAR(design.bias->part, 0.35, 0.04) << natural;
      }
      // γ of a velocity of 1 is g m v/T over the limit.
      const double velocity = design.scales.velocity_m_per_s;
      EXPECT_NEAR(design.bias->gain, design.bias->part * 0.02 * velocity * 60e3 / 2.0,
                  1e-9 * design.bias->gain);
    }
  }
}

TEST(BiasDesignTest, OfASensorlessLoopDoesNotDependOnTheDelayThatItPredicts) {
  const double part = design_control(biased(0.03, 1, false)).bias->part;
  EXPECT_EQ(design_control(biased(0.03, 4, false)).bias->part, part);
}

TEST(BiasDesignTest, RefusesAModeThatItCannotDamp) {
  EXPECT_THROW(design_control(biased(0.13, 1, true)), ConfigurationError);
  EXPECT_THROW(design_control(biased(0.09, 2, true)), ConfigurationError);
  EXPECT_NO_THROW(design_control(biased(0.001, 1, true)));
  EXPECT_THROW(design_control(biased(0.001, 1, false)), ConfigurationError);
}

}  // namespace
}  // namespace sonoglide::configure::bias_design_test
