#include "host_sim/boards/unit/tare.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace sonoglide::unit::tare_test {
namespace {

std::array<double, tare_readings> alternating(std::size_t every) {
  std::array<double, tare_readings> readings{};
  for (std::size_t i = 0; i < tare_readings; ++i) {
    readings.at(i) = 5.0 + (i / every % 2 == 0 ? 1.0 : -1.0);
  }
  return readings;
}

TEST(MeanOf, HasTheStandardErrorOfSixteenBatches) {
  const Mean slow = mean_of(alternating(16));  // the batches are at 6 and 4 in turn
  EXPECT_DOUBLE_EQ(slow.value, 5.0);
  EXPECT_DOUBLE_EQ(slow.standard_error, std::sqrt(16.0 / 15.0) / 4.0);
  const Mean fast = mean_of(alternating(1));  // every batch is at 5
  EXPECT_DOUBLE_EQ(fast.value, 5.0);
  EXPECT_EQ(fast.standard_error, 0.0);
}

TEST(MeanOf, OfEqualReadingsIsExact) {
  std::array<double, tare_readings> readings{};
  readings.fill(0.1);
  EXPECT_EQ(mean_of(readings).value, 0.1);
  EXPECT_EQ(mean_of(readings).standard_error, 0.0);
}

// A sensor that reads 3 where the force is 0: the unit shows 0.5 (3 - 1).
TEST(OffsetThatIs, IsWhatTheSensorReads) {
  EXPECT_DOUBLE_EQ(offset_that_is(1.0, 1.0, 0.5), 3.0);
}

}  // namespace
}  // namespace sonoglide::unit::tare_test
