#include "firmware/control/slew_limit.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdint>

#include "firmware/control/no_slew_limit.hpp"
#include "scalars.hpp"

namespace sonoglide::control {
namespace {

template <class Scalar>
class SlewLimitTest : public testing::Test {};
TYPED_TEST_SUITE(SlewLimitTest, Scalars);

template <class Scalar>
Scalar any_amplitude() {
  return numeric::from_code<Scalar>(*rc::gen::inRange<std::int32_t>(0, INT32_MAX));
}

TYPED_TEST(SlewLimitTest, RisesAndFallsByTheStatedAmount) {
  const SlewLimit<TypeParam> slew({scaled<TypeParam>(0.125)});
  const auto half = scaled<TypeParam>(0.5);
  EXPECT_EQ(numeric::to_real(slew.limit(scaled<TypeParam>(0.9), half)), 0.625);
  EXPECT_EQ(numeric::to_real(slew.limit(scaled<TypeParam>(0.1), half)), 0.375);
  EXPECT_EQ(numeric::to_real(slew.limit(scaled<TypeParam>(0.625), half)), 0.625);
  EXPECT_EQ(numeric::to_real(slew.limit(scaled<TypeParam>(0.375), half)), 0.375);
}

TYPED_TEST(SlewLimitTest, NeverMovesFasterNorPastWhatIsWanted) {
  EXPECT_TRUE(rc::check([] {
    const auto wanted = any_amplitude<TypeParam>();
    const auto previous = any_amplitude<TypeParam>();
    const auto most = any_amplitude<TypeParam>();
    const double limited = numeric::to_real(SlewLimit<TypeParam>({most}).limit(wanted, previous));
    const double from = numeric::to_real(previous);
    const double to = numeric::to_real(wanted);
    RC_ASSERT(std::abs(limited - from) <= numeric::to_real(most) + resolution<TypeParam>());
    RC_ASSERT(limited >= std::min(from, to) && limited <= std::max(from, to));
  }));
}

// Else a rounding would be reported as a limit.
TYPED_TEST(SlewLimitTest, ReachesExactlyWhatIsWithinReach) {
  EXPECT_TRUE(rc::check([] {
    const auto wanted = any_amplitude<TypeParam>();
    const auto previous = any_amplitude<TypeParam>();
    const SlewLimit<TypeParam> slew({numeric::from_code<TypeParam>(INT32_MAX)});
    RC_ASSERT(slew.limit(wanted, previous) == wanted);
  }));
}

TYPED_TEST(SlewLimitTest, NoLimitIsTheIdentity) {
  const NoSlewLimit<TypeParam> none({});
  EXPECT_EQ(numeric::to_real(none.limit(scaled<TypeParam>(0.875), TypeParam{})), 0.875);
}

}  // namespace
}  // namespace sonoglide::control
