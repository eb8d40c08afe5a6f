#include "host_sim/loop/control/sensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "firmware/numeric/scalar.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::loop::sensor_test {
namespace {

constexpr double full_scale_N = 0.04;
constexpr double full_speed_m_per_s = 0.25;
constexpr double period_s = 1.0 / 60e3;
constexpr configure::ControlScales scales{period_s, full_scale_N, full_speed_m_per_s, 1920.0};
constexpr double unit = numeric::from_code<double>(1);

double force_N(const hal::Sample& sample) {
  return sample.friction_force * unit * full_scale_N;
}

/// Values that leave the range on both sides, on codes, between them and where rounding is a tie.
std::vector<double> range_of_values() {
  std::vector<double> values;
  for (int i = -2304; i <= 2304; ++i) {
    values.push_back(i / 2048.0);
    values.push_back(i / 2048.0 + 1e-4);
  }
  return values;
}

TEST(SensorTest, IdealOnePassesTheNearestCode) {
  Sensor sensor({}, scales);
  for (const double value : range_of_values()) {
    const hal::Sample sample = sensor.sample(value * full_scale_N, -value * full_speed_m_per_s);
    const double clipped = std::clamp(value, -1.0, 1.0 - unit);
    EXPECT_NEAR(sample.friction_force * unit, clipped, 0.5001 * unit) << value;
    EXPECT_NEAR(sample.sliding_velocity * unit, std::clamp(-value, -1.0, 1.0 - unit),
                0.5001 * unit);
    EXPECT_EQ(sample.force_at_rail, value <= -1.0 || value >= 1.0) << value;
    EXPECT_EQ(sample.velocity_at_rail, value <= -1.0 || value >= 1.0) << value;
    EXPECT_TRUE(sample.fresh);
  }
}

TEST(SensorTest, RoundsToTheNearestStepOfTheConverterAndFlagsItsRails) {
  constexpr double binary_full_scale_N = 0.03125;  // so that ties are ties
  for (int bits = 4; bits <= 32; ++bits) {
    scene::Sensor description;
    description.adc_bits = bits;
    Sensor sensor(description, {period_s, binary_full_scale_N, full_speed_m_per_s, 1920.0});
    const long double levels = std::ldexp(1.0L, bits - 1);
    for (const double value : range_of_values()) {
      const long double steps = static_cast<long double>(value) * levels;
      const long double code = std::clamp(std::floor(steps + 0.5L), -levels, levels - 1.0L);
      const hal::Sample sample = sensor.sample(value * binary_full_scale_N, 0.0);
      ASSERT_EQ(sample.friction_force, std::ldexp(code, 32 - bits)) << bits << ' ' << value;
      ASSERT_EQ(sample.force_at_rail, code == -levels || code == levels - 1.0L)
          << bits << ' ' << value;
    }
  }
}

TEST(SensorTest, SaturatesFarOutsideItsRange) {
  Sensor sensor({}, scales);
  const hal::Sample high = sensor.sample(1e9, 1e9);
  EXPECT_EQ(high.friction_force, INT32_MAX);
  EXPECT_EQ(high.sliding_velocity, INT32_MAX);
  EXPECT_TRUE(high.force_at_rail);
  EXPECT_TRUE(high.velocity_at_rail);
  const hal::Sample low = sensor.sample(-1e9, -1e9);
  EXPECT_EQ(low.friction_force, INT32_MIN);
  EXPECT_EQ(low.sliding_velocity, INT32_MIN);
  EXPECT_TRUE(low.force_at_rail);
  EXPECT_TRUE(low.velocity_at_rail);
}

TEST(SensorTest, LowPassAnswersARampExactly) {
  for (const double bandwidth_Hz : {50.0, 5e3, 60e3, 1e6}) {
    scene::Sensor description;
    description.force_bandwidth_Hz = bandwidth_Hz;
    Sensor sensor(description, scales);
    const double lag_s = 1.0 / (tests::two_pi * bandwidth_Hz);
    const double slope_N_per_s = full_scale_N / (250.0 * period_s);
    for (int k = 1; k <= 200; ++k) {
      const double t = k * period_s;
      const double expected = slope_N_per_s * (t + lag_s * std::expm1(-t / lag_s));
      EXPECT_NEAR(force_N(sensor.sample(slope_N_per_s * t, 0.0)), expected, unit * full_scale_N)
          << bandwidth_Hz << ' ' << k;
    }
  }
}

TEST(SensorTest, LowPassAnswersAStepExactly) {
  // The step is a ramp over the first period, then constant.
  for (const double bandwidth_Hz : {50.0, 5e3, 60e3}) {
    scene::Sensor description;
    description.force_bandwidth_Hz = bandwidth_Hz;
    Sensor sensor(description, scales);
    const double lag_s = 1.0 / (tests::two_pi * bandwidth_Hz);
    const double height_N = 0.5 * full_scale_N;
    for (int k = 1; k <= 200; ++k) {
      const double left =
          lag_s / period_s * std::expm1(period_s / lag_s) * std::exp(-k * period_s / lag_s);
      EXPECT_NEAR(force_N(sensor.sample(height_N, 0.0)), height_N * (1.0 - left),
                  unit * full_scale_N)
          << bandwidth_Hz << ' ' << k;
    }
  }
}

TEST(SensorTest, DelaysTheForceByWholePeriodsAndTheSpeedNotAtAll) {
  for (const int delay : {0, 1, 3, 64}) {
    scene::Sensor description;
    description.delay_periods = delay;
    Sensor sensor(description, scales);
    Sensor prompt({}, scales);
    std::vector<std::int32_t> sent;
    for (int k = 0; k < 150; ++k) {
      const double force = full_scale_N * std::sin(0.7 * k + 1.0) * 0.9;
      const double speed = full_speed_m_per_s * std::cos(0.3 * k) * 0.9;
      const hal::Sample late = sensor.sample(force, speed);
      const hal::Sample now = prompt.sample(force, speed);
      sent.push_back(now.friction_force);
      EXPECT_EQ(late.friction_force, k < delay ? 0 : sent[static_cast<std::size_t>(k - delay)]);
      EXPECT_EQ(late.sliding_velocity, now.sliding_velocity);
    }
  }
}

scene::Sensor miswired(double force_gain, double force_offset_N, double velocity_gain,
                       double velocity_offset_m_per_s) {
  scene::Sensor description;
  description.force_gain = force_gain;
  description.force_offset_N = force_offset_N;
  description.velocity_gain = velocity_gain;
  description.velocity_offset_m_per_s = velocity_offset_m_per_s;
  return description;
}

TEST(SensorTest, GainAndOffsetAreOfTheReadingAlone) {
  for (const double gain : {-1.0, 0.0, 0.5, 1.25}) {
    for (const double offset : {-0.25, 0.0, 0.125}) {  // of full scale
      Sensor sensor(miswired(gain, offset * full_scale_N, -gain, -offset * full_speed_m_per_s),
                    scales);
      for (const double value : {-0.5, -0.125, 0.0, 0.25, 0.5}) {
        const hal::Sample sample = sensor.sample(value * full_scale_N, value * full_speed_m_per_s);
        EXPECT_NEAR(sample.friction_force * unit, gain * value + offset, 0.51 * unit);
        EXPECT_NEAR(sample.sliding_velocity * unit, -gain * value - offset, 0.51 * unit);
        EXPECT_FALSE(sample.force_at_rail);
      }
    }
  }
}

TEST(SensorTest, AnOffsetCanLeadToTheRailAndIsFlagged) {
  Sensor sensor(miswired(1.0, full_scale_N, 1.0, 2.0 * full_speed_m_per_s), scales);
  const hal::Sample sample = sensor.sample(0.25 * full_scale_N, 0.0);
  EXPECT_TRUE(sample.force_at_rail);
  EXPECT_EQ(sample.friction_force, INT32_MAX);
  EXPECT_EQ(sample.sliding_velocity, INT32_MAX);
}

TEST(SensorTest, GainAndOffsetComeBehindLowPassAndDelayAndBeforeNoiseAndConverter) {
  scene::Sensor plain;
  plain.force_bandwidth_Hz = 5e3;
  plain.delay_periods = 2;
  scene::Sensor wired = plain;
  wired.force_gain = -0.5;
  wired.force_offset_N = 0.25 * full_scale_N;
  scene::Sensor noisy = wired;
  noisy.force_noise_N = 1e-4;
  noisy.adc_bits = 12;
  scene::Sensor only_noise;
  only_noise.force_noise_N = 1e-4;
  Sensor plain_sensor(plain, scales);
  Sensor wired_sensor(wired, scales);
  Sensor noisy_sensor(noisy, scales);
  Sensor noise_sensor(only_noise, scales);
  const double code = std::ldexp(1.0, -11);
  for (int k = 0; k < 100; ++k) {
    const double force = 0.8 * full_scale_N * std::sin(0.3 * k + 1.0);
    const double passed = plain_sensor.sample(force, 0.0).friction_force * unit;
    const double expected = 0.25 - 0.5 * passed;
    EXPECT_NEAR(wired_sensor.sample(force, 0.0).friction_force * unit, expected, 1.01 * unit) << k;
    const double noise = noise_sensor.sample(0.0, 0.0).friction_force * unit;
    const double read = noisy_sensor.sample(force, 0.0).friction_force * unit;
    EXPECT_NEAR(read, expected + noise, 0.501 * code) << k;
    EXPECT_EQ(std::remainder(read, code), 0.0) << "the converter is the last";
  }
}

TEST(SensorTest, ADeadSensorReadsItsOffset) {
  Sensor sensor(miswired(0.0, 0.0, 0.0, 0.0), scales);
  const hal::Sample sample = sensor.sample(-0.5 * full_scale_N, -0.5 * full_speed_m_per_s);
  EXPECT_EQ(sample.friction_force, 0);
  EXPECT_EQ(sample.sliding_velocity, 0);
  EXPECT_FALSE(sample.force_at_rail);
}

TEST(SensorTest, TheVibrationHasItsOwnGainNoiseAndConverters) {
  scene::Sensor plain;
  plain.vibration_bits = 12;
  Sensor sensor(plain, scales, 0.8);
  const double code = std::ldexp(1.0, -11);
  for (const double part : {-0.9, -0.3, 0.0, 0.4, 1.1}) {
    const hal::VibrationSample sample =
        sensor.sample(0.0, 0.0, {part * full_speed_m_per_s, -0.5 * part * full_speed_m_per_s});
    EXPECT_NEAR(sample.in_phase * unit, 0.8 * part, 0.501 * code);
    EXPECT_NEAR(sample.quadrature * unit, -0.4 * part, 0.501 * code);
    EXPECT_EQ(std::remainder(sample.in_phase * unit, code), 0.0);
    EXPECT_FALSE(sample.vibration_at_rail);
    EXPECT_TRUE(sample.vibration_fresh);
  }
  EXPECT_TRUE(sensor.sample(0.0, 0.0, {0.0, -1.3 * full_speed_m_per_s}).vibration_at_rail);

  scene::Sensor noisy;
  noisy.vibration_noise_m_per_s = 0.01 * full_speed_m_per_s;
  Sensor noise(noisy, scales);
  double square = 0.0;
  double product = 0.0;
  constexpr int count = 20'000;
  for (int i = 0; i < count; ++i) {
    const hal::VibrationSample sample = noise.sample(0.0, 0.0, {0.0, 0.0});
    square += std::pow(sample.in_phase * unit, 2) / count;
    product += sample.in_phase * unit * (sample.quadrature * unit) / count;
  }
  EXPECT_NEAR(std::sqrt(square), 0.01, 0.0003);
  EXPECT_NEAR(product, 0.0, 5e-6);
}

TEST(SensorTest, TheSlidingVelocityHasAConverterOfItsOwn) {
  for (const int bits : {4, 12, 20}) {
    scene::Sensor description;
    description.velocity_bits = bits;
    Sensor sensor(description, scales);
    const double code = std::ldexp(1.0, 1 - bits);
    for (const double value : range_of_values()) {
      const hal::Sample sample = sensor.sample(0.0, value * full_speed_m_per_s);
      const double clipped = std::clamp(value, -1.0, 1.0 - code);
      EXPECT_NEAR(sample.sliding_velocity * unit, clipped, 0.5001 * code);
      EXPECT_EQ(std::remainder(sample.sliding_velocity * unit, code), 0.0);
    }
  }
}

/// Each of the conversions is rounded and has its noise; a rail in one of them is one of the reading.
TEST(SensorTest, TheReadingIsTheMeanOfItsConversions) {
  scene::Sensor description;
  description.adc_bits = 8;
  description.samples_per_period = 4;
  Sensor sensor(description, scales);
  const double code = std::ldexp(1.0, -7);
  const std::vector<double> codes = {3.2, 3.4, 3.6, -20.0};
  std::vector<double> forces_N;
  for (const double value : codes) {
    forces_N.push_back(value * code * full_scale_N);
  }
  const hal::Sample sample = sensor.sample({0.0, forces_N}, 0.0);
  EXPECT_EQ(sample.friction_force * unit, (3.0 + 3.0 + 4.0 - 20.0) / 4.0 * code);
  EXPECT_FALSE(sample.force_at_rail);
  forces_N[1] = 2.0 * full_scale_N;
  EXPECT_TRUE(sensor.sample({0.0, forces_N}, 0.0).force_at_rail);

  description.adc_bits.reset();
  description.force_noise_N = 0.01 * full_scale_N;
  EXPECT_DOUBLE_EQ(description.reading_noise_N(), 0.005 * full_scale_N);
  Sensor noisy(description, scales);
  double square = 0.0;
  constexpr int count = 20'000;
  for (int i = 0; i < count; ++i) {
    square += std::pow(noisy.sample(0.0, 0.0).friction_force * unit, 2) / count;
  }
  EXPECT_NEAR(std::sqrt(square), 0.005, 0.00015);
}

TEST(SensorTest, ConversionsAreDelayedByWholePeriods) {
  scene::Sensor description;
  description.samples_per_period = 3;
  description.delay_periods = 2;
  Sensor sensor(description, scales);
  for (int k = 0; k < 10; ++k) {
    const double force_N = k * 0.05 * full_scale_N;
    const hal::Sample sample = sensor.sample({0.0, {0.5 * force_N, force_N, 1.5 * force_N}}, 0.0);
    EXPECT_NEAR(sample.friction_force * unit, std::max(0, k - 2) * 0.05, unit);
  }
}

TEST(SensorTest, PeriodsThatNobodyLooksAtPassThroughFilterAndDelay) {
  for (const bool sampled : {false, true}) {
    scene::Sensor description;
    description.delay_periods = 2;
    (sampled ? description.filter_Hz : description.force_bandwidth_Hz) = 5e3;
    if (sampled) {
      description.samples_per_period = 3;
    }
    Sensor watched(description, scales);
    Sensor passed(description, scales);
    for (int k = 0; k < 100; ++k) {
      const double force_N = full_scale_N * std::sin(0.7 * k) * 0.9;
      const PeriodForce force(force_N, sampled
                                           ? std::vector<double>{0.5 * force_N, force_N, force_N}
                                           : std::vector<double>{});
      const hal::Sample seen = watched.sample(force, 0.0);
      if (k % 7 == 6) {
        EXPECT_EQ(passed.sample(force, 0.0).friction_force, seen.friction_force) << k;
      } else {
        passed.pass(force);
      }
    }
  }
}

TEST(SensorTest, WithoutAForceSensorTheForceReadsZero) {
  scene::Sensor none;
  none.force = false;
  EXPECT_EQ(Sensor(none, scales).sample(0.5 * full_scale_N, 0.0).friction_force, 0);
}

constexpr double noise_N = 1e-4;

std::vector<double> noise_samples(std::uint64_t seed, int count, double offset_N = 0.0) {
  scene::Sensor description;
  description.force_noise_N = noise_N;
  description.seed = seed;
  Sensor sensor(description, scales);
  std::vector<double> samples;
  for (int i = 0; i < count; ++i) {
    samples.push_back(force_N(sensor.sample(offset_N, 0.0)) - offset_N);
  }
  return samples;
}

TEST(SensorTest, NoiseIsWhiteAndNormal) {
  constexpr int count = 100000;
  const std::vector<double> samples = noise_samples(1, count);
  double sum = 0.0;
  double square = 0.0;
  double cube = 0.0;
  double fourth = 0.0;
  double neighbours = 0.0;
  int beyond_1 = 0;
  int beyond_2 = 0;
  int beyond_3 = 0;
  double last = 0.0;
  for (const double sample : samples) {
    const double z = sample / noise_N;
    sum += z;
    square += z * z;
    cube += z * z * z;
    fourth += z * z * z * z;
    neighbours += z * last;
    last = z;
    beyond_1 += std::abs(z) > 1.0 ? 1 : 0;
    beyond_2 += std::abs(z) > 2.0 ? 1 : 0;
    beyond_3 += std::abs(z) > 3.0 ? 1 : 0;
  }
  const double n = count;
  const double five_sigma = 5.0 / std::sqrt(n);
  EXPECT_NEAR(sum / n, 0.0, five_sigma);
  EXPECT_NEAR(std::sqrt(square / n), 1.0, five_sigma / std::sqrt(2.0));
  EXPECT_NEAR(cube / n, 0.0, five_sigma * std::sqrt(15.0));
  EXPECT_NEAR(fourth / n, 3.0, five_sigma * std::sqrt(96.0));
  EXPECT_NEAR(neighbours / n, 0.0, five_sigma);
  const auto expect_share = [&](int beyond, double share) {
    EXPECT_NEAR(beyond / n, share, 5.0 * std::sqrt(share * (1.0 - share) / n));
  };
  expect_share(beyond_1, 0.3173105078629141);
  expect_share(beyond_2, 0.0455002638963584);
  expect_share(beyond_3, 0.0026997960632602);
}

TEST(SensorTest, NoiseIsTheSameForTheSameSeedAndAnotherForAnother) {
  EXPECT_EQ(noise_samples(7, 1000), noise_samples(7, 1000));
  EXPECT_NE(noise_samples(7, 1000), noise_samples(8, 1000));
}

TEST(SensorTest, NoiseIsBoxAndMullersFromTheMersenneTwister) {
  std::mt19937_64 generator(42);
  const std::vector<double> samples = noise_samples(42, 1000);
  for (const double sample : samples) {
    const long double radius_draw =
        std::ldexp(static_cast<long double>(generator() >> 11) + 1, -53);
    const long double angle_draw = std::ldexp(static_cast<long double>(generator() >> 11), -53);
    const long double expected = static_cast<long double>(noise_N) *
                                 std::sqrt(-2.0L * std::log(radius_draw)) *
                                 std::sin(tests::long_pi * (2.0L * angle_draw - 1.0L));
    EXPECT_NEAR(sample, static_cast<double>(expected), 0.51 * unit * full_scale_N);
  }
}

TEST(SensorTest, NoiseHasTheSameBitsOnEveryMachine) {
  scene::Sensor description;
  description.force_noise_N = noise_N;
  Sensor sensor(description, scales);
  for (const std::int32_t code : {528732236, 535978786, 540978071}) {
    EXPECT_EQ(sensor.sample(0.01, 0.0).friction_force, code);
  }
}

TEST(SensorTest, NoiseComesAfterTheDelay) {
  scene::Sensor description;
  description.force_noise_N = noise_N;
  description.delay_periods = 4;
  Sensor sensor(description, scales);
  EXPECT_NE(sensor.sample(0.01, 0.0).friction_force, 0);
}

}  // namespace
}  // namespace sonoglide::loop::sensor_test
