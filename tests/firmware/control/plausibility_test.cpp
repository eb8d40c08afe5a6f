#include "firmware/control/plausibility.hpp"

#include <gtest/gtest.h>

#include "scalars.hpp"

namespace sonoglide::control::plausibility_test {
namespace {

template <class Scalar>
class PlausibilityTest : public testing::Test {
 protected:
  static constexpr int periods = 7;

  bool implausible(double ratio) { return plausibility_.implausible(scaled<Scalar>(0.5 * ratio)); }

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
  for (const double ratio : {-0.14, 0.0, 0.5, 1.0, 1.29}) {
    for (int i = 0; i < 100; ++i) {
      ASSERT_FALSE(this->implausible(ratio)) << ratio;
    }
  }
}

}  // namespace
}  // namespace sonoglide::control::plausibility_test
