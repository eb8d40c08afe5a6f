#include "firmware/control/limits/slew_limit.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "scalars.hpp"

namespace sonoglide::control::slew_limit_test {
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

/// Steps in which every arithmetic holds amplitudes and their differences exactly.
constexpr std::int32_t exact_step = 256;

std::int32_t any_exact_code() {
  return exact_step * *rc::gen::inRange<std::int32_t>(0, INT32_MAX / exact_step);
}

// Else a rounding would be reported as a limit. A step less of reach, and the step is missing.
TYPED_TEST(SlewLimitTest, ReachesExactlyWhatIsWithinReach) {
  int reached = 0;
  EXPECT_TRUE(rc::check([&reached] {
    const std::int32_t wanted = any_exact_code();
    const std::int32_t previous = any_exact_code();
    const std::int32_t distance = std::abs(wanted - previous);
    RC_PRE(distance > exact_step);
    const auto after = [&](std::int32_t reach) {
      const SlewLimit<TypeParam> slew({numeric::from_code<TypeParam>(reach)});
      return slew.limit(numeric::from_code<TypeParam>(wanted),
                        numeric::from_code<TypeParam>(previous));
    };
    const std::int32_t spare = std::min(any_exact_code(), INT32_MAX - distance);
    RC_ASSERT(after(distance) == numeric::from_code<TypeParam>(wanted));
    RC_ASSERT(after(distance + spare) == numeric::from_code<TypeParam>(wanted));
    const std::int32_t nearest = wanted + (wanted < previous ? exact_step : -exact_step);
    RC_ASSERT(after(distance - exact_step) == numeric::from_code<TypeParam>(nearest));
    ++reached;
  }));
  EXPECT_GE(reached, 100);
}

TYPED_TEST(SlewLimitTest, NoLimitIsTheIdentity) {
  const NoSlewLimit<TypeParam> none({});
  EXPECT_EQ(numeric::to_real(none.limit(scaled<TypeParam>(0.875), TypeParam{})), 0.875);
}

}  // namespace
}  // namespace sonoglide::control::slew_limit_test
