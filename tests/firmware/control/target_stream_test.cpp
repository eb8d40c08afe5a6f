/// Targets that keep changing: feedback stays on.

#include <gtest/gtest.h>

#include "closed_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::target_stream_test {
namespace {

template <class Scalar>
class TargetStream : public testing::Test {
 protected:
  /// Mean ratio of the last half of a run in which two targets take turns, on a contact twice as
  /// stiff as believed: feedforward alone is off by 0.07.
  static double mean_ratio(double one, double other, int every) {
    ClosedLoop<ShapedParts<Scalar>> loop({}, Contact{0.5, 2.0 * 1.0108});
    double sum = 0.0;
    constexpr int periods = 2000;
    for (int i = 0; i < periods; ++i) {
      if (i % every == 0) {
        loop.set_target(i / every % 2 == 0 ? one : other);
      }
      loop.step();
      sum += i < periods / 2 ? 0.0 : loop.ratio();
    }
    return 2.0 * sum / periods;
  }
};
TYPED_TEST_SUITE(TargetStream, Scalars);

TYPED_TEST(TargetStream, TinyChangesSwitchNothingOff) {
  for (const int every : {1, 2, 5}) {
    EXPECT_NEAR(this->mean_ratio(0.5, 0.5 + 1e-6, every), 0.5, 1e-4) << every;
  }
}

TYPED_TEST(TargetStream, NorDoLargeOnes) {
  for (const int every : {3, 5, 10}) {
    EXPECT_NEAR(this->mean_ratio(0.45, 0.55, every), 0.5, 0.01) << every;
    EXPECT_NEAR(this->mean_ratio(0.4, 0.6, every), 0.5, 0.02) << every;
  }
}

// A ramp of 0.4 over 400 periods, in steps too small to hold the integral.
TYPED_TEST(TargetStream, ARampIsFollowedWithoutError) {
  ClosedLoop<ShapedParts<TypeParam>> loop({}, Contact{0.5, 2.0 * 1.0108});
  loop.set_target(0.8);
  loop.run(400);
  for (int i = 1; i <= 400; ++i) {
    const double target = 0.8 - 0.001 * i;
    loop.set_target(target);
    loop.step();
    if (i > 50) {
      ASSERT_NEAR(loop.ratio(), target, 0.006) << i;  // three periods of the ramp, and the map
    }
  }
}

}  // namespace
}  // namespace sonoglide::control::target_stream_test
