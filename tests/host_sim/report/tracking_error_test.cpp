#include "host_sim/report/step_metrics.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "periods.hpp"

namespace sonoglide::report::tracking_error_test {
namespace {

using scene::Scene;

std::optional<double> largest_tracking_error(const Scene& scene,
                                             const std::vector<loop::Period>& periods) {
  constexpr double speed_floor_m_per_s = 0.2;
  TrackingMeter meter(scene, speed_floor_m_per_s);
  for (const loop::Period& period : periods) {
    meter.take(period);
  }
  return meter.largest_error();
}

TEST(TrackingErrorTest, IsTheLargestOfTheRun) {
  const Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  const std::vector<loop::Period> periods = made_up_run(scene, [](int k) {
    return k == 30 ? 0.47 : k == 60 ? 0.51 : 0.5;
  });
  EXPECT_NEAR(largest_tracking_error(scene, periods).value(), 0.03, 1e-12);
}

TEST(TrackingErrorTest, LeavesOutTenPeriodsAfterEachStep) {
  const Scene scene = made_up_scene({{0.0, 0.5}, {0.05, 0.8}}, 0.1);
  const std::vector<loop::Period> late = made_up_run(scene, [](int k) {
    return k < 10 ? 1.0 : k < 50 ? 0.5 : k < 60 ? 0.5 : 0.8;
  });
  EXPECT_NEAR(largest_tracking_error(scene, late).value(), 0.0, 1e-12);
  const std::vector<loop::Period> later = made_up_run(scene, [](int k) {
    return k < 10 ? 1.0 : k < 50 ? 0.5 : k < 61 ? 0.5 : 0.8;
  });
  EXPECT_NEAR(largest_tracking_error(scene, later).value(), 0.3, 1e-12);
}

TEST(TrackingErrorTest, LeavesOutTenPeriodsAfterCalibration) {
  Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  scene.controller->calibration_s = 30e-3;
  const std::vector<loop::Period> periods =
      made_up_run(scene, [](int k) { return k < 40 ? 1.0 : 0.5; });
  EXPECT_NEAR(largest_tracking_error(scene, periods).value(), 0.0, 1e-12);
}

TEST(TrackingErrorTest, LeavesOutSlidingBelowTheFloorAtEitherEndOfAPeriod) {
  const Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  std::vector<loop::Period> periods =
      made_up_run(scene, [](int k) { return k == 40 || k == 50 ? 0.0 : 0.5; });
  EXPECT_NEAR(largest_tracking_error(scene, periods).value(), 0.5, 1e-12);
  periods[40].begin_velocity_m_per_s = -0.199;  // the floor is 0.2
  periods[50].end_velocity_m_per_s = 0.199;
  EXPECT_NEAR(largest_tracking_error(scene, periods).value(), 0.0, 1e-12);
  periods[50].end_velocity_m_per_s = -0.2;
  EXPECT_NEAR(largest_tracking_error(scene, periods).value(), 0.5, 1e-12);
}

TEST(TrackingErrorTest, LeavesOutTheActuatorsLimit) {
  const Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  std::vector<loop::Period> periods = made_up_run(scene, [](int k) { return k == 40 ? 0.7 : 0.5; });
  periods[40].limit = control::Limit::actuator;
  EXPECT_NEAR(largest_tracking_error(scene, periods).value(), 0.0, 1e-12);
}

TEST(TrackingErrorTest, IsAbsentWhereNothingCounts) {
  const Scene scene = made_up_scene({{0.0, 0.5}}, 8e-3);
  EXPECT_FALSE(largest_tracking_error(scene, made_up_run(scene, [](int) { return 0.5; })));
}

}  // namespace
}  // namespace sonoglide::report::tracking_error_test
