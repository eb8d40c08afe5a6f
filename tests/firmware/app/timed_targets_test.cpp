// The targets of an image, whose carrier periods may change their length.
#include "firmware/app/timed_targets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "firmware/app/target_schedule.hpp"

namespace sonoglide::app::timed_targets_test {
namespace {

constexpr double unit = 0x1p-20;

TEST(ElapsedPeriods, CountsPeriodsOfTheStartExactly) {
  ElapsedPeriods elapsed(1U << 28);
  for (std::uint64_t k = 1; k <= 100'000; ++k) {
    elapsed.add(0);
    ASSERT_EQ(elapsed.value(), k << ElapsedPeriods::fraction_bits);
  }
}

TEST(ElapsedPeriods, OtherPeriodsCountByTheirLength) {
  for (const std::uint32_t start : {555U, 1'515'000U, 1U << 28, 0x7fffffffU}) {
    std::mt19937 random(start);
    std::uniform_real_distribution<double> deviation(-0.06, 0.06);
    ElapsedPeriods elapsed(start);
    long double exact = 0.0L;
    for (int k = 1; k <= 10'000; ++k) {
      const auto steps = static_cast<std::int32_t>(deviation(random) * start);
      elapsed.add(steps);
      exact += static_cast<long double>(start) / (static_cast<long double>(start) + steps);
      ASSERT_NEAR(static_cast<double>(elapsed.value()) * unit, static_cast<double>(exact),
                  0.5 * unit * k + 1e-9);
    }
  }
}

struct ToldController {
  std::int32_t frequency = 0;
  std::vector<float> targets;

  std::int32_t next_frequency() const { return frequency; }
  void set_target(float target) { targets.push_back(target); }
};

TEST(TimedSchedule, SetsEachTargetWithTheFirstSampleAtItsTimeOrAfter) {
  const TimedTargets<float, 3> targets = {
      1000, {{0, 0.2F}, {std::uint64_t{5} << 20, 0.3F}, {(std::uint64_t{7} << 20) + 1, 0.4F}}};
  auto schedule = schedule_of(targets);
  ToldController controller;
  const auto advance = [&](std::int32_t frequency) {
    controller.frequency = frequency;
    schedule.advance(controller);
    return controller.targets.size();
  };
  EXPECT_EQ(advance(0), 1U);  // a time of 0 with the first sample
  EXPECT_EQ(advance(0), 1U);
  EXPECT_EQ(advance(-500), 1U);  // lasts two periods
  EXPECT_EQ(advance(0), 2U);     // 5 periods
  EXPECT_EQ(advance(1000), 2U);  // half a period
  EXPECT_EQ(advance(0), 2U);
  EXPECT_EQ(advance(1000), 2U);  // 7 periods, the target is due a unit later
  EXPECT_EQ(advance(0), 3U);
  EXPECT_EQ(advance(0), 3U);
  EXPECT_EQ(controller.targets, (std::vector<float>{0.2F, 0.3F, 0.4F}));
  EXPECT_EQ(controller.targets.front(), first_target(targets));
}

TEST(TargetSchedule, SetsEachTargetFromItsPeriodOn) {
  const TargetStep<float> steps[] = {{0, 0.2F}, {3, 0.3F}, {3, 0.4F}, {4, 0.5F}};
  auto schedule = schedule_of(steps);
  ToldController controller;
  for (const std::size_t set : {1U, 1U, 1U, 3U, 4U, 4U}) {
    schedule.advance(controller);
    EXPECT_EQ(controller.targets.size(), set);
  }
  EXPECT_EQ(controller.targets, (std::vector<float>{0.2F, 0.3F, 0.4F, 0.5F}));
  EXPECT_EQ(controller.targets.front(), first_target(steps));
}

}  // namespace
}  // namespace sonoglide::app::timed_targets_test
