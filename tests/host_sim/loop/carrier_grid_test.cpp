#include "host_sim/loop/plant/carrier_grid.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

namespace sonoglide::loop::carrier_grid_test {
namespace {

CarrierGrid grid_of(double frequency_Hz, double duration_s) {
  scene::Scene scene;
  scene.drive.emplace();
  scene.drive->frequency_Hz = frequency_Hz;
  scene.run.duration_s = duration_s;
  return CarrierGrid(scene);
}

TEST(CarrierGridTest, TilesARun) {
  const CarrierGrid grid = grid_of(60e3, 6e-3);
  ASSERT_EQ(grid.count(), 360U);
  EXPECT_EQ(grid.begin_s(0), 0.0);
  EXPECT_EQ(grid.end_s(359), 6e-3);
  for (std::uint64_t k = 0; k < grid.count(); ++k) {
    EXPECT_TRUE(grid.is_whole(k)) << k;
    EXPECT_EQ(grid.duration_s(k), 1.0 / 60e3) << k;
  }
}

TEST(CarrierGridTest, CutsTheLastPeriodShort) {
  const CarrierGrid grid = grid_of(1e3, 2.25e-3);
  ASSERT_EQ(grid.count(), 3U);
  EXPECT_TRUE(grid.is_whole(1));
  EXPECT_FALSE(grid.is_whole(2));
  EXPECT_NEAR(grid.duration_s(2), 0.25e-3, 1e-18);
  EXPECT_EQ(grid_of(1e3, 0.25e-3).count(), 1U);
}

TEST(CarrierGridTest, HasNoSliverAtTheEndOfALongRun) {
  // Durations whose decimal figure and whose multiple of the period differ by rounding.
  for (const double frequency_Hz : {60e3, 26e3, 39999.7}) {
    for (double periods = 7.0; periods < 1e10; periods = 3.0 * periods + 1.0) {
      const CarrierGrid grid = grid_of(frequency_Hz, periods / frequency_Hz);
      ASSERT_EQ(grid.count(), static_cast<std::uint64_t>(periods)) << frequency_Hz;
      EXPECT_TRUE(grid.is_whole(grid.count() - 1)) << periods;
      EXPECT_EQ(grid.duration_s(grid.count() - 1), grid.period_s()) << periods;
    }
  }
}

TEST(CarrierGridTest, FindsThePeriodsAboutATime) {
  const CarrierGrid grid = grid_of(60e3, 1.0);
  EXPECT_EQ(grid.at_or_after(0.0), 0U);
  EXPECT_EQ(grid.at_or_after(2e-3), 120U) << "which is 120 periods but for rounding";
  EXPECT_EQ(grid.over_at(2e-3), 120U);
  EXPECT_EQ(grid.at_or_after(2.001e-3), 121U);
  EXPECT_EQ(grid.over_at(2.001e-3), 120U);
}

TEST(CarrierGridTest, KnowsAWholeNumberOfPeriods) {
  const CarrierGrid grid = grid_of(60e3, 1.0);
  EXPECT_EQ(grid.whole_periods(0.0), 0U);
  EXPECT_EQ(grid.whole_periods(2e-3), 120U);
  EXPECT_EQ(grid.whole_periods(1.0), 60000U);
  EXPECT_EQ(grid.whole_periods(2.001e-3), std::nullopt);
  EXPECT_EQ(grid.whole_periods(0.5 / 60e3), std::nullopt);
}

TEST(CarrierGridTest, WithoutADriveHasAThousandPieces) {
  scene::Scene scene;
  scene.run.duration_s = 0.7;
  const CarrierGrid grid(scene);
  EXPECT_EQ(grid.count(), 1000U);
  EXPECT_EQ(grid.end_s(999), 0.7);
}

}  // namespace
}  // namespace sonoglide::loop::carrier_grid_test
