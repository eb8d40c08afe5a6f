#include "host_sim/loop/recorder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sonoglide::loop {
namespace {

/// Goes through [0, end_s] in stretches of the given length; every state is its own time.
void record(Recorder& recorder, double stretch_s, double end_s) {
  const int stretches = static_cast<int>(std::lround(end_s / stretch_s));
  for (int i = 0; i < stretches; ++i) {
    const double begin_s = i * stretch_s;
    const bool last = i + 1 == stretches;
    const double stop_s = last ? end_s : (i + 1) * stretch_s;
    const std::vector<double> offsets_s = recorder.plan(begin_s, stop_s, last);
    std::vector<PlantState> seen;
    for (const double offset_s : offsets_s) {
      EXPECT_GE(offset_s, 0.0);
      EXPECT_LE(offset_s, stop_s - begin_s);
      seen.push_back({begin_s + offset_s, 0.0, 0.0});
    }
    recorder.take(begin_s, {stop_s - begin_s, 0.0, 0.0, 0.0, 0.0, 0.0}, seen);
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

TEST(RecorderTest, TakesBothEnds) {
  Recorder recorder;
  Recording recording;
  recorder.want(0.0, 1.0, 0.125, recording);
  record(recorder, 0.25, 1.0);
  expect_times(recording, 0.0, 0.125, 9);
  EXPECT_EQ(recording.time_s.front(), 0.0);
  EXPECT_EQ(recording.time_s.back(), 1.0);
}

TEST(RecorderTest, TakesBothEndsWhereDecimalsDoNotDivide) {
  Recorder recorder;
  Recording recording;
  recorder.want(0.0, 6e-3, 1e-6, recording);  // 6e-3 / 1e-6 is not a whole number in binary
  record(recorder, 1.0 / 60e3, 6e-3);
  expect_times(recording, 0.0, 1e-6, 6001);
}

TEST(RecorderTest, LeavesOutTheEndThatIsNotOnTheGrid) {
  Recorder recorder;
  Recording recording;
  recorder.want(0.0, 1.0, 0.3, recording);
  record(recorder, 0.1, 1.0);
  expect_times(recording, 0.0, 0.3, 4);
}

TEST(RecorderTest, TakesNothingTwiceAtTheSeams) {
  Recorder recorder;
  Recording recording;
  recorder.want(0.0, 1.0, 0.1, recording);
  record(recorder, 0.1, 1.0);
  expect_times(recording, 0.0, 0.1, 11);
}

TEST(RecorderTest, ServesOverlappingRequestsAtOnce) {
  Recorder recorder;
  Recording coarse;
  Recording fine;
  Recording inside;
  Recording same;
  recorder.want(0.0, 2.0, 0.5, coarse);
  recorder.want(0.75, 1.5, 0.0625, fine);
  recorder.want(1.1, 1.2, 0.01, inside);
  recorder.want(0.0, 2.0, 0.5, same);
  record(recorder, 0.25, 2.0);
  expect_times(coarse, 0.0, 0.5, 5);
  expect_times(fine, 0.75, 0.0625, 13);
  expect_times(inside, 1.1, 0.01, 11);
  EXPECT_EQ(same.time_s, coarse.time_s);
}

TEST(RecorderTest, TakesOneSampleOfAnIntervalLongerThanTheRun) {
  Recorder recorder;
  Recording recording;
  recorder.want(0.0, 1.0, 50.0, recording);
  record(recorder, 0.25, 1.0);
  expect_times(recording, 0.0, 50.0, 1);
}

TEST(RecorderTest, NotesDriveAndSlidingAtEachSample) {
  Recorder recorder;
  Recording recording;
  recorder.want(1.0, 2.0, 0.5, recording);
  const std::vector<double> offsets_s = recorder.plan(1.0, 2.0, true);
  ASSERT_EQ(offsets_s, (std::vector<double>{0.0, 0.5, 1.0}));
  const double quarter_turn_per_s = 1.57079632679489661923;
  recorder.take(1.0, {1.0, 2.0 * quarter_turn_per_s, 2.0 * quarter_turn_per_s, 8.0, 3.0, -4.0},
                {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, {7.0, 8.0, 9.0}});
  EXPECT_NEAR(recording.drive_force_N[0], -8.0, 1e-14);
  EXPECT_NEAR(recording.drive_force_N[1], 0.0, 1e-14);
  EXPECT_NEAR(recording.drive_force_N[2], 8.0, 1e-14);
  EXPECT_EQ(recording.sliding_velocity_m_per_s, (std::vector<double>{3.0, 1.0, -1.0}));
  EXPECT_EQ(recording.state[1].velocity_m_per_s, 5.0);
  EXPECT_EQ(recording.state[2].friction_force_N, 9.0);
}

}  // namespace
}  // namespace sonoglide::loop
