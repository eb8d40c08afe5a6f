#include "firmware/control/limits/standstill_hold.hpp"

#include <gtest/gtest.h>

#include "scalars.hpp"

namespace sonoglide::control::standstill_hold_test {
namespace {

template <class Scalar>
class StandstillHoldTest : public testing::Test {};
TYPED_TEST_SUITE(StandstillHoldTest, Scalars);

TYPED_TEST(StandstillHoldTest, HoldsForTheStatedPeriodsAndThenFallsToZero) {
  StandstillHold<TypeParam> hold({5, scaled<TypeParam>(0.125)});
  for (int round = 0; round < 3; ++round) {
    TypeParam amplitude = scaled<TypeParam>(0.5);
    for (int i = 0; i < 5; ++i) {
      amplitude = hold.request(amplitude);
      ASSERT_EQ(numeric::to_real(amplitude), 0.5);
    }
    for (const double left : {0.375, 0.25, 0.125, 0.0, 0.0}) {
      amplitude = hold.request(amplitude);
      ASSERT_EQ(numeric::to_real(amplitude), left);
    }
    hold.restart();
  }
}

TYPED_TEST(StandstillHoldTest, WithoutAHoldItFallsAtOnce) {
  StandstillHold<TypeParam> hold({0, scaled<TypeParam>(0.25)});
  EXPECT_EQ(numeric::to_real(hold.request(scaled<TypeParam>(0.75))), 0.5);
}

}  // namespace
}  // namespace sonoglide::control::standstill_hold_test
