#include "host_sim/loop/sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "host_sim/loop/watch.hpp"

namespace sonoglide::loop::sampler_test {
namespace {

/// Goes through [0, end_s] in stretches of the given length; every state is its own time.
void sample(const std::vector<Sampling>& wanted, double stretch_s, double end_s) {
  Sampler sampler(wanted);
  const int stretches = static_cast<int>(std::lround(end_s / stretch_s));
  for (int i = 0; i < stretches; ++i) {
    const double begin_s = i * stretch_s;
    const bool last = i + 1 == stretches;
    const double stop_s = last ? end_s : (i + 1) * stretch_s;
    if (!sampler.wants_before(stop_s)) {
      EXPECT_TRUE(Sampler(sampler).plan(begin_s, stop_s, last).empty());
      continue;
    }
    const std::vector<double> offsets_s = sampler.plan(begin_s, stop_s, last);
    std::vector<PlantState> seen;
    for (const double offset_s : offsets_s) {
      EXPECT_GE(offset_s, 0.0);
      EXPECT_LE(offset_s, stop_s - begin_s);
      seen.push_back({begin_s + offset_s, 0.0, 0.0});
    }
    sampler.deliver(begin_s, {stop_s - begin_s, 0.0, 0.0, 0.0, 0.0, 0.0}, seen);
  }
}

void expect_times(const Recording& recording, double begin_s, double interval_s, int count) {
  ASSERT_EQ(recording.time_s.size(), static_cast<std::size_t>(count));
  ASSERT_EQ(recording.state.size(), recording.time_s.size());
  ASSERT_EQ(recording.drive_force_N.size(), recording.time_s.size());
  ASSERT_EQ(recording.sliding_velocity_m_per_s.size(), recording.time_s.size());
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    EXPECT_NEAR(recording.time_s[index], begin_s + i * interval_s, 1e-9 * interval_s) << i;
    EXPECT_EQ(recording.state[index].displacement_m, recording.time_s[index]);
  }
}

TEST(SamplerTest, TakesBothEnds) {
  Recording recording;
  sample({{{0.0, 1.0, 0.125}, &recording}}, 0.25, 1.0);
  expect_times(recording, 0.0, 0.125, 9);
  EXPECT_EQ(recording.time_s.front(), 0.0);
  EXPECT_EQ(recording.time_s.back(), 1.0);
}

TEST(SamplerTest, TakesBothEndsWhereDecimalsDoNotDivide) {
  Recording recording;
  // 6e-3 / 1e-6 is not a whole number in binary.
  sample({{{0.0, 6e-3, 1e-6}, &recording}}, 1.0 / 60e3, 6e-3);
  expect_times(recording, 0.0, 1e-6, 6001);
}

TEST(SamplerTest, LeavesOutTheEndThatIsNotOnTheGrid) {
  Recording recording;
  sample({{{0.0, 1.0, 0.3}, &recording}}, 0.1, 1.0);
  expect_times(recording, 0.0, 0.3, 4);
}

TEST(SamplerTest, TakesNothingTwiceAtTheSeams) {
  Recording recording;
  sample({{{0.0, 1.0, 0.1}, &recording}}, 0.1, 1.0);
  expect_times(recording, 0.0, 0.1, 11);
}

TEST(SamplerTest, ServesOverlappingRequestsAtOnce) {
  Recording coarse;
  Recording fine;
  Recording inside;
  Recording same;
  sample({{{0.0, 2.0, 0.5}, &coarse},
          {{0.75, 1.5, 0.0625}, &fine},
          {{1.1, 1.2, 0.01}, &inside},
          {{0.0, 2.0, 0.5}, &same}},
         0.25, 2.0);
  expect_times(coarse, 0.0, 0.5, 5);
  expect_times(fine, 0.75, 0.0625, 13);
  expect_times(inside, 1.1, 0.01, 11);
  EXPECT_EQ(same.time_s, coarse.time_s);
}

TEST(SamplerTest, TakesOneSampleOfAnIntervalLongerThanTheRun) {
  Recording recording;
  sample({{{0.0, 1.0, 50.0}, &recording}}, 0.25, 1.0);
  expect_times(recording, 0.0, 50.0, 1);
}

TEST(SamplerTest, NotesDriveAndSlidingAtEachSample) {
  Recording recording;
  Sampler sampler({{{1.0, 2.0, 0.5}, &recording}});
  const std::vector<double> offsets_s = sampler.plan(1.0, 2.0, true);
  ASSERT_EQ(offsets_s, (std::vector<double>{0.0, 0.5, 1.0}));
  const double quarter_turn_per_s = 1.57079632679489661923;
  sampler.deliver(1.0, {1.0, 2.0 * quarter_turn_per_s, 2.0 * quarter_turn_per_s, 8.0, 3.0, -4.0},
                  {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, {7.0, 8.0, 9.0}});
  EXPECT_NEAR(recording.drive_force_N[0], -8.0, 1e-14);
  EXPECT_NEAR(recording.drive_force_N[1], 0.0, 1e-14);
  EXPECT_NEAR(recording.drive_force_N[2], 8.0, 1e-14);
  EXPECT_EQ(recording.sliding_velocity_m_per_s, (std::vector<double>{3.0, 1.0, -1.0}));
  EXPECT_EQ(recording.state[1].velocity_m_per_s, 5.0);
  EXPECT_EQ(recording.state[2].friction_force_N, 9.0);
}

TEST(SamplerTest, WantsNothingWhereNobodyWatches) {
  const double whole_run_s = 1e9;
  EXPECT_FALSE(Sampler({}).wants_before(whole_run_s));
}

TEST(SamplerTest, WantsNothingBeforeTheFirstSampleNorAfterTheLast) {
  Recording recording;
  Sampler sampler({{{1.0, 2.0, 0.5}, &recording}});
  EXPECT_FALSE(sampler.wants_before(0.999));
  EXPECT_TRUE(sampler.wants_before(1.001));
  sampler.plan(1.0, 1.4, false);
  EXPECT_FALSE(sampler.wants_before(1.4));
  EXPECT_TRUE(sampler.wants_before(1.6));
  sampler.plan(1.4, 2.1, true);
  EXPECT_FALSE(sampler.wants_before(1e9));
}

}  // namespace
}  // namespace sonoglide::loop::sampler_test
