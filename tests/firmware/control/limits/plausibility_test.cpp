#include "firmware/control/limits/plausibility.hpp"

#include <gtest/gtest.h>

#include "scalars.hpp"

namespace sonoglide::control::plausibility_test {
namespace {

template <class Scalar>
class PlausibilityTest : public testing::Test {
 protected:
  static constexpr int periods = 7;

  bool implausible(double ratio, double velocity = 0.1) {
    return !plausibility_.plausible(scaled<Scalar>(0.5 * ratio), scaled<Scalar>(velocity));
  }
  bool stood_still(double ratio, double velocity) const {
    return plausibility_.stood_still(scaled<Scalar>(0.5 * ratio), scaled<Scalar>(velocity));
  }

  Plausibility<Scalar> plausibility_{{periods}};
};
TYPED_TEST_SUITE(PlausibilityTest, Scalars);

TYPED_TEST(PlausibilityTest, TripsAfterMoreReadingsInARowThanAreGranted) {
  for (const double ratio : {-0.16, -1.0, 1.31, 1.9}) {
    this->plausibility_.restart();
    for (int i = 0; i < this->periods; ++i) {
      ASSERT_FALSE(this->implausible(ratio)) << ratio;
    }
    EXPECT_TRUE(this->implausible(ratio)) << ratio;
    EXPECT_TRUE(this->implausible(ratio)) << ratio;
  }
}

TYPED_TEST(PlausibilityTest, AReadingInsideBeginsTheCountAnew) {
  for (int i = 0; i < 100; ++i) {
    ASSERT_FALSE(this->implausible(i % 8 == 7 ? 1.29 : 1.4)) << i;
  }
}

TYPED_TEST(PlausibilityTest, ContactsStayInside) {
  for (const double ratio : {-0.14, -0.0, 0.0, 0.5, 1.0, 1.29}) {
    for (int i = 0; i < 100; ++i) {
      ASSERT_FALSE(this->implausible(ratio)) << ratio;
    }
  }
}

// Friction that pulls at the velocity at which it resisted: not at another, not from the start, and
// not too much of it.
TYPED_TEST(PlausibilityTest, AVelocityThatStoodStillWhileFrictionTurnedIsTold) {
  EXPECT_FALSE(this->stood_still(-0.4, 0.1));
  this->implausible(0.4, 0.1);
  this->implausible(-0.4, 0.1);
  EXPECT_TRUE(this->stood_still(-0.4, 0.1));
  EXPECT_FALSE(this->stood_still(-0.4, 0.11));
  EXPECT_FALSE(this->stood_still(1.4, 0.1));
  this->implausible(0.4, 0.2);
  EXPECT_FALSE(this->stood_still(-0.4, 0.1));
  this->plausibility_.restart();
  EXPECT_FALSE(this->stood_still(-0.4, 0.2));
}

}  // namespace
}  // namespace sonoglide::control::plausibility_test
