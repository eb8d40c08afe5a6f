#include "host_sim/long_work/pace.hpp"

#include <gtest/gtest.h>

namespace sonoglide::long_work::pace_test {
namespace {

/// A clock that stands until it is told to go on.
class PaceTest : public testing::Test {
 protected:
  Pace pace() {
    return Pace(progress_, [this] { return now_s_; });
  }
  /// What a progress bar works out from the last fraction.
  double left_s() const { return (now_s_ - start_s) * (1.0 - fraction_) / fraction_; }

  static constexpr double start_s = 100.0;
  double now_s_ = start_s;
  double fraction_ = -1.0;
  Progress progress_ = [this](double fraction) { fraction_ = fraction; };
};

TEST_F(PaceTest, InOneStageItIsThePartOfThePoints) {
  Pace pace = this->pace();
  pace.begin(10, 0.0);
  for (int i = 1; i <= 10; ++i) {
    now_s_ += 2.0;
    pace.add(1);
    EXPECT_DOUBLE_EQ(fraction_, 0.1 * i);
  }
}

TEST_F(PaceTest, TheTimeLeftIsRightInBothStages) {
  Pace pace = this->pace();
  pace.begin(1000, 9.0);  // 10 s, then 90 s
  for (int i = 0; i < 10; ++i) {
    now_s_ += 1.0;
    pace.add(100);
    EXPECT_NEAR(left_s(), start_s + 100.0 - now_s_, 1e-9);
  }
  pace.begin(1000, 0.0);
  for (int i = 0; i < 10; ++i) {
    now_s_ += 9.0;
    pace.add(100);
    EXPECT_NEAR(left_s(), start_s + 100.0 - now_s_, 1e-9);
  }
  EXPECT_EQ(fraction_, 1.0);
}

TEST_F(PaceTest, AWrongExpectationIsForgottenOnceThePointsAreSolved) {
  Pace pace = this->pace();
  pace.begin(100, 1.0);
  now_s_ += 1.0;
  pace.add(100);
  pace.begin(100, 0.0);
  now_s_ += 50.0;
  pace.add(1);
  EXPECT_NEAR(left_s(), 99 * 50.0, 1e-6);
}

TEST_F(PaceTest, WhatWasFinishedBeforeDoesNotCount) {
  Pace pace = this->pace();
  pace.begin(100, 1.0);
  now_s_ += 1.0;
  pace.add(100);
  pace.begin(10, 0.0);  // the other 90 stand in a journal
  now_s_ += 3.0;
  pace.add(1);
  EXPECT_NEAR(left_s(), 27.0, 1e-9);
}

TEST_F(PaceTest, AClockTooCoarseGivesNothing) {
  Pace pace = this->pace();
  pace.begin(10, 0.0);
  pace.add(1);
  EXPECT_EQ(fraction_, 0.0);
}

TEST(QuietPaceTest, NeedsNoListener) {
  const Progress none;
  Pace pace(none);
  pace.begin(1, 0.0);
  pace.add(1);
}

}  // namespace
}  // namespace sonoglide::long_work::pace_test
