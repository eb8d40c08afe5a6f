#include "firmware/control/limits/stuck_detector.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "scalars.hpp"

namespace sonoglide::control::stuck_detector_test {
namespace {

template <class Scalar>
class StuckDetectorTest : public testing::Test {
 protected:
  static constexpr int periods = 12;

  /// @param ratio  the commanded friction ratio itself
  bool stuck(double reading, double ratio, bool followed = true) {
    return detector_.stuck(scaled<Scalar>(reading), scaled<Scalar>(0.5 * measured_ratio),
                           scaled<Scalar>(0.5 * ratio), followed);
  }
  /// Calls with this reading and command until the trip; -1 for none within `most`.
  int calls_until_stuck(double reading, double ratio, int most = 1000) {
    for (int call = 1; call <= most; ++call) {
      if (stuck(reading, ratio)) {
        return call;
      }
    }
    return -1;
  }

  double measured_ratio = 0.5;  ///< that the reading stands for
  StuckDetector<Scalar> detector_{typename StuckDetector<Scalar>::Parameters{periods}};
};
TYPED_TEST_SUITE(StuckDetectorTest, Scalars);

TYPED_TEST(StuckDetectorTest, AMovingReadingNeverTrips) {
  for (int i = 0; i < 10'000; ++i) {
    ASSERT_FALSE(this->stuck(0.3 + 1e-6 * (i % 2), i % 3 == 0 ? 0.1 : 0.9));
  }
}

TYPED_TEST(StuckDetectorTest, AConstantReadingUnderAConstantCommandNeverTrips) {
  EXPECT_EQ(this->calls_until_stuck(0.3, 0.5, 100'000), -1);
}

TYPED_TEST(StuckDetectorTest, AConstantReadingUnderAMovedCommandTripsAfterTheStatedPeriods) {
  ASSERT_FALSE(this->stuck(0.3, 0.9));
  EXPECT_EQ(this->calls_until_stuck(0.3, 0.4), this->periods);
}

TYPED_TEST(StuckDetectorTest, AReadingThatChangesAtTheLastMomentIsAlive) {
  for (int round = 0; round < 50; ++round) {
    const double reading = 0.1 + 0.01 * round;
    ASSERT_FALSE(this->stuck(reading, 0.9));
    for (int call = 1; call < this->periods; ++call) {
      ASSERT_FALSE(this->stuck(reading, 0.4));
    }
  }
}

TYPED_TEST(StuckDetectorTest, ADriftIsToldByItsWholeLength) {
  ASSERT_FALSE(this->stuck(0.3, 0.25));
  int calls = 1;
  while (!this->stuck(0.3, 0.25 + calls / 256.0)) {
    ++calls;
  }
  EXPECT_EQ(calls, 64 + this->periods - 1);  // 64/256 is a quarter
}

TYPED_TEST(StuckDetectorTest, LessThanAQuarterTellsNothing) {
  ASSERT_FALSE(this->stuck(0.3, 0.5));
  EXPECT_EQ(this->calls_until_stuck(0.3, 0.745), -1);
  EXPECT_EQ(this->calls_until_stuck(0.3, 0.255), -1);
}

// The command came far and went back: a live reading would have shown it.
TYPED_TEST(StuckDetectorTest, AnExcursionTellsToo) {
  ASSERT_FALSE(this->stuck(0.3, 0.5));
  ASSERT_FALSE(this->stuck(0.3, 0.9));
  EXPECT_EQ(this->calls_until_stuck(0.3, 0.5), this->periods - 1);
}

// A settled contact stands still for as long as one likes; when the command then moves, the reading
// has the stated periods from there on to follow.
TYPED_TEST(StuckDetectorTest, AStandstillBeforeTheCommandMovedDoesNotCount) {
  ASSERT_EQ(this->calls_until_stuck(0.3, 0.9, 500), -1);
  for (int call = 1; call < this->periods; ++call) {
    ASSERT_FALSE(this->stuck(0.3, 0.4)) << "call " << call;
  }
  EXPECT_FALSE(this->stuck(0.2, 0.4));
}

TYPED_TEST(StuckDetectorTest, NothingIsConcludedWhileTheDriveCannotFollow) {
  ASSERT_FALSE(this->stuck(0.3, 0.9));
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(this->stuck(0.3, 0.4, false));
  }
  EXPECT_EQ(this->calls_until_stuck(0.3, 0.4), this->periods);
}

// The reading came to rest while the drive was on its way to a command it could not follow yet.
TYPED_TEST(StuckDetectorTest, AChangeOnTheWayIsMeasuredFromTheCommandOfThatTime) {
  ASSERT_FALSE(this->stuck(0.3, 0.3));
  ASSERT_FALSE(this->stuck(0.5, 1.0, false));
  EXPECT_EQ(this->calls_until_stuck(0.5, 1.0), -1);
}

// Vibration slower than the sliding leaves the friction as it is, to the last code.
TYPED_TEST(StuckDetectorTest, AReadingOfUndrivenFrictionNeedsACommandFartherAway) {
  this->measured_ratio = 1.0;
  ASSERT_FALSE(this->stuck(0.5, 1.0));
  EXPECT_EQ(this->calls_until_stuck(0.5, 0.26), -1);
  EXPECT_EQ(this->calls_until_stuck(0.5, 0.25), this->periods);
}

TYPED_TEST(StuckDetectorTest, NothingIsConcludedWhereTheDriveMayHaveNoEffect) {
  StuckDetector<TypeParam> detector({0});
  const auto ratio = scaled<TypeParam>(0.25);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(detector.stuck(ratio, ratio, scaled<TypeParam>(i == 0 ? 0.5 : 0.0), true));
  }
}

TYPED_TEST(StuckDetectorTest, ARestartGivesTheFullTimeAgain) {
  ASSERT_FALSE(this->stuck(0.3, 0.9));
  ASSERT_EQ(this->calls_until_stuck(0.3, 0.4), this->periods);
  this->detector_.restart();
  ASSERT_FALSE(this->stuck(0.3, 0.9));
  EXPECT_EQ(this->calls_until_stuck(0.3, 0.4), this->periods);
}

}  // namespace
}  // namespace sonoglide::control::stuck_detector_test
