// A board on its own timer: every period is counted, also where the counter wraps and nobody waits.
#include "hal/timed/board.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "hal/timed/volatile_pages.hpp"

extern "C" {
volatile std::int32_t drive_amplitude = 0;
}

namespace sonoglide::hal::timed::timed_board_test {
namespace {

/// A counter of 24 bits that the test turns, or that goes on by itself whenever it is read.
struct TurnedClock {
  static constexpr std::uint32_t hz = 1000;
  static constexpr std::uint32_t largest = 0x00ffffff;

  static inline std::uint32_t now = 0;
  static inline std::uint32_t by_itself = 0;

  std::uint32_t ticks() const {
    now += by_itself;
    return now & largest;
  }
};

static_assert(Board<TurnedClock>::clock_hz == TurnedClock::hz);

class TimedBoard : public testing::Test {
 protected:
  static constexpr std::uint32_t period_ticks = 1000;

  static void turn(std::uint32_t ticks) { TurnedClock::now += ticks; }

  /// Its counter is about to wrap.
  static Board<TurnedClock> start() {
    TurnedClock::now = 0x00fffe00;
    TurnedClock::by_itself = 0;
    drive_amplitude = 0;
    return Board<TurnedClock>(period_ticks);
  }

  Board<TurnedClock> board = start();
};

TEST_F(TimedBoard, CountsPeriodsAcrossTheCountersWrap) {
  EXPECT_EQ(board.period(), 0U);
  turn(period_ticks - 1);
  EXPECT_EQ(board.period(), 0U);
  turn(1);
  EXPECT_EQ(board.period(), 1U);
  for (std::uint32_t period = 2; period < 100000; ++period) {
    turn(period_ticks);
    ASSERT_EQ(board.period(), period);
  }
}

TEST_F(TimedBoard, CountsThePeriodsThatNobodyWaitedFor) {
  turn(17 * period_ticks + 3);
  EXPECT_EQ(board.period(), 17U);
  turn(period_ticks - 3);
  EXPECT_EQ(board.period(), 18U);
}

TEST_F(TimedBoard, GivesOneSampleForEachPeriodAndWaitsForTheNext) {
  Sample sample{};
  turn(period_ticks);
  ASSERT_TRUE(board.sample(sample));
  EXPECT_EQ(board.period(), 1U);
  TurnedClock::by_itself = 10;
  ASSERT_TRUE(board.sample(sample));
  EXPECT_EQ(board.period(), 2U);
}

TEST_F(TimedBoard, DrivesFromTheNextPeriodOn) {
  Sample sample{};
  turn(period_ticks);
  board.sample(sample);
  EXPECT_EQ(sample.friction_force, StandInContact::undriven_friction);
  board.drive({INT32_MAX, 0, 0, 0, 0, 0});
  turn(period_ticks);
  board.sample(sample);
  EXPECT_LT(sample.friction_force, StandInContact::undriven_friction / 10 * 6);
  EXPECT_TRUE(sample.fresh);
  EXPECT_FALSE(sample.force_at_rail);
}

// As an exception's handler takes the drive away, behind the loop's back.
TEST_F(TimedBoard, IsNotDrivenWhereTheRegisterIsCleared) {
  Sample sample{};
  board.drive({INT32_MAX, 0, 0, 0, 0, 0});
  drive_amplitude = 0;
  turn(10 * period_ticks);
  board.sample(sample);
  EXPECT_EQ(sample.friction_force, StandInContact::undriven_friction);
}

TEST(StandInContact, SettlesAtTheRatioOfSlidingToVibrationVelocity) {
  for (std::int32_t amplitude = 0; amplitude < INT32_MAX - 9999999; amplitude += 9999999) {
    StandInContact contact;
    contact.drive(amplitude);
    for (int period = 0; period < 40; ++period) {
      contact.live();
    }
    const double expected = amplitude <= StandInContact::velocity
                                ? 1.0
                                : static_cast<double>(StandInContact::velocity) / amplitude;
    const double ratio =
        static_cast<double>(contact.sample().friction_force) / StandInContact::undriven_friction;
    ASSERT_NEAR(ratio, expected, 0x1p-11) << amplitude;
  }
}

TEST(VolatilePages, AreErasedAtFirstAndOnlyClearBits) {
  VolatilePages pages;
  EXPECT_EQ(pages.read(1, VolatilePages::page_words - 1), 0xffffffffU);
  pages.program(0, 3, 0xffff0000U);
  pages.program(0, 3, 0x0f0f0f0fU);
  EXPECT_EQ(pages.read(0, 3), 0x0f0f0000U);
  EXPECT_EQ(pages.read(1, 3), 0xffffffffU);
  pages.erase(0);
  EXPECT_EQ(pages.read(0, 3), 0xffffffffU);
  EXPECT_FALSE(pages.busy());
}

}  // namespace
}  // namespace sonoglide::hal::timed::timed_board_test
