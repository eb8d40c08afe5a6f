#include "firmware/app/force_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "tests/firmware/app/unit/simulated_unit.hpp"

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
TEST(ForceCalibration, IsWithinFourCodesOfTheRealNumbersOrAtTheRail) {
  std::mt19937 random(2);
  int at_rail = 0;
  for (int i = 0; i < 300'000; ++i) {
    const auto reading = static_cast<std::int32_t>(random());
    const auto offset = static_cast<std::int32_t>(random() % 500'001) - 250'000;
    const auto gain = static_cast<std::uint32_t>(500'000 + random() % 1'500'001);
    const long double force = gain / 1e6L * (reading - offset * 0x1p31L / 1e6L);
    const hal::Sample sample = applied(reading, offset, gain);
    if (sample.force_at_rail) {
      ++at_rail;
      ASSERT_EQ(sample.friction_force, force < 0 ? INT32_MIN : INT32_MAX);
      ASSERT_GT(std::abs(force), 0x1p31L - 5);
    } else {
      ASSERT_LE(std::abs(sample.friction_force - force), 4.0L);
    }
  }
  EXPECT_GT(at_rail, 1000);
}

TEST(ForceCalibration, AReadingAtTheRailStaysThere) {
  hal::Sample sample{1 << 30, 0, true, true};
  ForceCalibration::of(0, 500'000).apply(sample);
  EXPECT_TRUE(sample.force_at_rail);
  EXPECT_EQ(sample.friction_force, 1 << 29);
}

// Also while the board's hardware holds the unit in a fault.
TEST(ForceCalibration, IsOfEverySampleThatAUnitShows) {
  using Supervisor = TestedUnit::Supervisor;
  Supervisor supervisor(field_design.controller_parameters(field_design.presets()),
                        field_design.designed(), 0, 10, OrderedTargets(),
                        ForceCalibration::of(0, 500'000));
  const hal::Sample sample{1 << 30, 0, false, true};
  supervisor.step(sample);
  EXPECT_EQ(supervisor.friction_force(), 1 << 29);
  supervisor.step({});
  supervisor.hold(sample, 1);
  EXPECT_EQ(supervisor.friction_force(), 1 << 29);
}

}  // namespace
}  // namespace sonoglide::app::force_calibration_test
