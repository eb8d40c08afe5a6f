#include "firmware/control/friction/friction_level.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scalars.hpp"

namespace sonoglide::control::friction_level_test {
namespace {

template <class Scalar>
class FrictionLevelTest : public testing::Test {};
TYPED_TEST_SUITE(FrictionLevelTest, Scalars);

/// F/(2 Fc) of the very numbers that the scalar holds.
template <class Scalar>
long double exact_half_ratio(Scalar force, Scalar friction_force) {
  return static_cast<long double>(numeric::to_real(force)) /
         (2.0L * static_cast<long double>(numeric::to_real(friction_force)));
}

/// Inverse and product each round by half a unit; the shift carries both along.
template <class Scalar>
long double allowance(long double half_ratio, Scalar friction_force) {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return std::ldexp(static_cast<long double>(resolution<Scalar>()),
                      1 - numeric::split(friction_force).exponent);
  } else {
    return 2.0L * static_cast<long double>(resolution<Scalar>()) * std::abs(half_ratio);
  }
}

template <class Scalar>
void expect_exact(double friction, double ratio) {
  const auto friction_force = scaled<Scalar>(friction);
  const auto force = scaled<Scalar>(ratio * friction);
  const long double exact = exact_half_ratio(force, friction_force);
  const auto measured = FrictionLevel<Scalar>(friction_force).half_ratio(force);
  EXPECT_LE(std::abs(static_cast<long double>(numeric::to_real(measured)) - exact),
            allowance(exact, friction_force))
      << "Fc " << friction << " ratio " << ratio;
}

TYPED_TEST(FrictionLevelTest, DividesAsExactArithmeticDoesFromTheSmallestForceUp) {
  int divided = 0;
  for (double friction = 1.0 / 1024.0; friction < 0.999; friction *= 1.0137) {
    for (double ratio = -1.99; ratio < 1.99; ratio += 0.0731) {
      if (std::abs(ratio * friction) < 1.0) {
        expect_exact<TypeParam>(friction, ratio);
        ++divided;
      }
    }
  }
  EXPECT_GE(divided, 20000);
}

TYPED_TEST(FrictionLevelTest, DividesAsExactArithmeticDoesForAnyPair) {
  EXPECT_TRUE(rc::check([] {
    const auto friction =
        *rc::gen::inRange<std::int64_t>(std::int64_t{1} << 21, std::int64_t{1} << 31);
    // A measured ratio within ±2.
    const auto most = std::min(std::int64_t{1} << 31, 2 * friction - 4096);
    const auto force = *rc::gen::inRange<std::int64_t>(1 - most, most);
    const double unit = resolution<Saturated>();
    expect_exact<TypeParam>(static_cast<double>(friction) * unit,
                            static_cast<double>(force) / static_cast<double>(friction));
  }));
}

TYPED_TEST(FrictionLevelTest, TheFrictionForceItselfIsAHalf) {
  for (const double friction : {1.0 / 1024.0, 0.25, 0.3, 0.5, 0.75, 0.999}) {
    const auto friction_force = scaled<TypeParam>(friction);
    const double half =
        numeric::to_real(FrictionLevel<TypeParam>(friction_force).half_ratio(friction_force));
    EXPECT_NEAR(half, 0.5, static_cast<double>(allowance<TypeParam>(0.5L, friction_force)));
  }
}

TEST(FrictionLevelSaturation, EndsAtRatiosOfTwoInFixedPoint) {
  const FrictionLevel<Saturated> level(scaled<Saturated>(0.25));
  EXPECT_EQ(level.half_ratio(scaled<Saturated>(0.75)), Saturated::largest());
  EXPECT_EQ(level.half_ratio(scaled<Saturated>(-0.75)), Saturated::lowest());
  EXPECT_LT(level.half_ratio(scaled<Saturated>(0.4999)), Saturated::largest());
}

}  // namespace
}  // namespace sonoglide::control::friction_level_test
