#include "host_sim/loop/control/actuator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "firmware/numeric/scalar.hpp"
#include "host_sim/loop/plant/period_drive.hpp"

namespace sonoglide::loop {
namespace {

constexpr double limit_N = 1920.0;

scene::Scene with_bits(int bits) {
  scene::Scene scene;
  scene.drive.emplace();
  scene.drive->max_force_amplitude_N = limit_N;
  scene.drive->delay_periods = 0;
  scene.drive->bits = bits;
  return scene;
}

TEST(ActuatorTest, GivesTheNearestAmplitude) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> codes(-INT32_MAX, INT32_MAX);
  for (const int bits : {4, 11, 16}) {
    Actuator actuator(with_bits(bits));
    const double step_N = std::ldexp(limit_N, -bits);
    for (int i = 0; i < 1000; ++i) {
      hal::Drive drive{};
      drive.amplitude = codes(random);
      actuator.take(drive, 0.5);
      const double given_N = actuator.in_force().amplitude_N;
      EXPECT_NEAR(given_N, numeric::from_code<double>(drive.amplitude) * limit_N, 0.5001 * step_N);
      EXPECT_EQ(std::remainder(given_N, step_N), 0.0);
    }
  }
}

TEST(ActuatorTest, AnAnswerHoldsUntilTheNextOneActs) {
  for (const int delay : {0, 1, 5}) {
    scene::Scene scene = with_bits(31);
    scene.drive->delay_periods = delay;
    Actuator actuator(scene);
    constexpr int every = 3;
    for (int period = 0; period < 60; ++period) {
      if (period % every == every - 1) {
        hal::Drive drive{};
        drive.amplitude = (period + 1) << 20;
        actuator.take(drive, 0.5);
      } else {
        actuator.hold();
      }
      // In force in the next period: the last answer that is old enough.
      const int answered = (period + 1 - delay) / every * every;
      const double wanted_N = answered > 0 ? std::ldexp(limit_N, -11) * answered : 0.0;
      EXPECT_NEAR(actuator.in_force().amplitude_N, wanted_N, 1e-5) << period << ' ' << delay;
    }
  }
}

TEST(ActuatorTest, CodesWithinAPeriodAreAmplitudesThatItGives) {
  scene::Scene scene = with_bits(6);
  scene.drive->interpolation = scene::Interpolation::linear;
  scene.drive->codes_per_period = 8;
  const PeriodDrive drive(scene, 300.0, 1200.0, 0.0);
  for (int i = 0; i < drive.parts(); ++i) {
    const double given_N = drive.part(i).amplitude_N;
    EXPECT_EQ(std::remainder(given_N, limit_N / 64.0), 0.0);
    EXPECT_NEAR(given_N, 300.0 + 900.0 * (i + 0.5) / 8.0, limit_N / 128.0);
  }
}

}  // namespace
}  // namespace sonoglide::loop
