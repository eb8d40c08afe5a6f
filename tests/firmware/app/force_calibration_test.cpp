#include "firmware/app/force_calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "hal/board.hpp"

namespace sonoglide::app::force_calibration_test {
namespace {

hal::Sample applied(std::int32_t reading, std::int32_t offset, std::uint32_t gain) {
  hal::Sample sample{reading, 0, false, true};
  ForceCalibration::of(static_cast<std::uint32_t>(offset), gain).apply(sample);
  return sample;
}

TEST(ForceCalibration, OffsetZeroAndGainOneChangeNoBit) {
  std::mt19937 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const auto reading = static_cast<std::int32_t>(random());
    const hal::Sample sample = applied(reading, 0, 1'000'000);
    ASSERT_EQ(sample.friction_force, reading);
    ASSERT_FALSE(sample.force_at_rail);
  }
  for (const std::int32_t rail : {INT32_MIN, INT32_MAX}) {
    EXPECT_EQ(applied(rail, 0, 1'000'000).friction_force, rail);
    EXPECT_FALSE(applied(rail, 0, 1'000'000).force_at_rail);
  }
}

// gain (reading - offset) in long double; the error that the docstring states.
TEST(ForceCalibration, HasTheStatedErrorAgainstTheRealNumbersOrIsAtTheRail) {
  std::mt19937 random(2);
  int at_rail = 0;
  long double largest = 0.0L;
  for (int i = 0; i < 300'000; ++i) {
    const auto reading = static_cast<std::int32_t>(random());
    const auto offset = static_cast<std::int32_t>(random() % 500'001) - 250'000;
    const auto gain = static_cast<std::uint32_t>(500'000 + random() % 1'000'001);
    const long double force = gain / 1e6L * (reading - offset * 0x1p31L / 1e6L);
    const long double error = 0x1p31L * (0x1p-15L * std::abs(gain / 1e6L - 1) + 0x1p-23L) +
                              0x1p-17L * std::abs(force) / (gain / 1e6L);
    const hal::Sample sample = applied(reading, offset, gain);
    if (sample.force_at_rail) {
      ++at_rail;
      ASSERT_EQ(sample.friction_force, force < 0 ? INT32_MIN : INT32_MAX);
      ASSERT_GT(std::abs(force), 0x1p31L - error - 1);
    } else {
      ASSERT_LE(std::abs(sample.friction_force - force), error);
      largest = std::max(largest, std::abs(sample.friction_force - force) * 0x1p-31L);
    }
  }
  EXPECT_GT(at_rail, 1000);
  EXPECT_LE(largest, 2.5e-5L);
}

TEST(ForceCalibration, AReadingAtTheRailStaysThere) {
  hal::Sample sample{1 << 30, 0, true, true};
  ForceCalibration::of(0, 500'000).apply(sample);
  EXPECT_TRUE(sample.force_at_rail);
  EXPECT_EQ(sample.friction_force, 1 << 29);
}

TEST(ForceCalibration, OfAUnitThatReadsNoForceLeavesItsSamplesAsTheyAre) {
  hal::Sample sample{1 << 30, 1 << 20, false, true};
  NoForceCalibration::of(1000, 500'000).apply(sample);
  EXPECT_EQ(sample.friction_force, 1 << 30);
  EXPECT_EQ(sample.sliding_velocity, 1 << 20);
}

}  // namespace
}  // namespace sonoglide::app::force_calibration_test
