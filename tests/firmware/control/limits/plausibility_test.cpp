#include "firmware/control/limits/plausibility.hpp"

#include <gtest/gtest.h>

#include "scalars.hpp"

namespace sonoglide::control::plausibility_test {
namespace {

template <class Scalar>
class PlausibilityTest : public testing::Test {
 protected:
  static constexpr int periods = 7;

  Fault judge(double ratio, double velocity = 0.1) {
    return plausibility_.judge(scaled<Scalar>(0.5 * ratio), scaled<Scalar>(velocity));
  }
  /// Of the last of more such readings than are granted.
  Fault lasting(double ratio, double velocity) {
    for (int i = 0; i < periods; ++i) {
      EXPECT_EQ(judge(ratio, velocity), Fault::none);
    }
    return judge(ratio, velocity);
  }

  Plausibility<Scalar> plausibility_{{periods}};
};
TYPED_TEST_SUITE(PlausibilityTest, Scalars);

TYPED_TEST(PlausibilityTest, TripsAfterMoreReadingsInARowThanAreGranted) {
  for (const double ratio : {-0.16, -1.0, 1.31, 1.9}) {
    this->plausibility_.restart();
    for (int i = 0; i < this->periods; ++i) {
      ASSERT_EQ(this->judge(ratio), Fault::none) << ratio;
    }
    EXPECT_EQ(this->judge(ratio), Fault::measurement_implausible) << ratio;
    EXPECT_EQ(this->judge(ratio), Fault::measurement_implausible) << ratio;
  }
}

TYPED_TEST(PlausibilityTest, AReadingInsideBeginsTheCountAnew) {
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(this->judge(i % 8 == 7 ? 1.29 : 1.4), Fault::none) << i;
  }
}

TYPED_TEST(PlausibilityTest, ContactsStayInside) {
  for (const double ratio : {-0.14, -0.0, 0.0, 0.5, 1.0, 1.29}) {
    for (int i = 0; i < 100; ++i) {
      ASSERT_EQ(this->judge(ratio), Fault::none) << ratio;
    }
  }
}

// Friction that pulls at the velocity at which it resisted: not at another, not from the start, and
// not too much of it.
TYPED_TEST(PlausibilityTest, AVelocityThatStoodStillWhileFrictionTurnedIsTold) {
  EXPECT_EQ(this->lasting(-0.4, 0.1), Fault::measurement_implausible);
  this->judge(0.4, 0.1);
  EXPECT_EQ(this->lasting(-0.4, 0.1), Fault::velocity_stuck);
  EXPECT_EQ(this->judge(-0.4, 0.11), Fault::measurement_implausible);
  EXPECT_EQ(this->judge(1.4, 0.1), Fault::measurement_implausible);
  this->judge(0.4, 0.2);
  EXPECT_EQ(this->lasting(-0.4, 0.1), Fault::measurement_implausible);
  this->judge(0.4, 0.2);
  this->plausibility_.restart();
  EXPECT_EQ(this->lasting(-0.4, 0.2), Fault::measurement_implausible);
}

}  // namespace
}  // namespace sonoglide::control::plausibility_test
