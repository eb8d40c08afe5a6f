/// Sliding that slows down and stops: the drive never rises for it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "closed_loop.hpp"
#include "scalars.hpp"
#include "scripted_run.hpp"

namespace sonoglide::control::standstill_test {
namespace {

/// Table 1, and its plant on a soft spring (7e6 N/m), whose notch needs a spacing of 4.
std::vector<Design> designs() {
  Design table_1;
  table_1.lead_periods = 2.5;
  Design soft = table_1;
  soft.spacing = 4;
  soft.taps = {0.5146, -0.0292, 0.5146};
  soft.lead_periods = 5.5;
  soft.gain = 0.05;
  soft.hold_periods = 12;
  soft.stuck_periods = 18;
  return {table_1, soft};
}

template <class Scalar>
class Standstill : public testing::Test {
 protected:
  using Loop = ClosedLoop<ShapedParts<Scalar>>;

  /// At rest on its target, at a speed of 0.1.
  static Loop settled(const Design& design) {
    Loop loop(design);
    loop.set_target(0.4);
    loop.run(400);
    return loop;
  }
  /// Roundings of the shaper's sum.
  static constexpr double allowance = 1e-6;
};
TYPED_TEST_SUITE(Standstill, Scalars);

TYPED_TEST(Standstill, AStopLeavesTheDriveWhereItWas) {
  for (const Design& design : designs()) {
    auto loop = this->settled(design);
    const double before = loop.amplitude();
    for (int i = 0; i < 1000; ++i) {
      const auto& command = loop.step(0.0);
      ASSERT_EQ(command.limit, Limit::speed_floor) << i;
      ASSERT_NEAR(loop.amplitude(), before, 1e-4) << i;
    }
  }
}

TYPED_TEST(Standstill, AfterTheStatedTimeTheDriveFallsToZero) {
  for (Design design : designs()) {
    design.standstill_hold_periods = 100;
    auto loop = this->settled(design);
    const double before = loop.amplitude();
    loop.run(100, 0.0);
    EXPECT_NEAR(loop.amplitude(), before, 1e-4);
    double last = loop.amplitude();
    for (int i = 0; i < 140; ++i) {
      loop.step(0.0);
      ASSERT_LE(loop.amplitude(), last + this->allowance) << i;
      last = loop.amplitude();
    }
    EXPECT_EQ(loop.amplitude(), 0.0);
    EXPECT_EQ(loop.command().limit, Limit::speed_floor);
    loop.run(400);
    EXPECT_NEAR(loop.ratio(), 0.4, 1e-4);
    EXPECT_EQ(loop.command().limit, Limit::none);
  }
}

// However the sliding slows down: what the drive had at the highest speed is the most it has.
TYPED_TEST(Standstill, TheDriveNeverExceedsWhatItHadWhileTheSpeedFalls) {
  Sequence sequence(11);
  for (const Design& design : designs()) {
    for (int run = 0; run < 60; ++run) {
      auto loop = this->settled(design);
      const double before = loop.amplitude();
      const double slowing = std::pow(10.0, -4.0 + 3.0 * sequence.next());
      double speed = 0.1;
      while (speed > 0.0) {
        speed = std::max(0.0, speed - slowing * 2.0 * sequence.next());
        loop.step(speed);
        ASSERT_LE(loop.amplitude(), before * 1.01) << "slowing " << slowing << " at " << speed;
      }
      for (int i = 0; i < 50; ++i) {
        loop.step(0.0);
        ASSERT_LE(loop.amplitude(), before * 1.01) << "slowing " << slowing;
      }
    }
  }
}

/// Feedforward alone: with feedback the sensor's noise would be in the drive.
TYPED_TEST(Standstill, TheDriveFallsWithTheSpeed) {
  for (Design design : designs()) {
    design.gain = 0.0;
    for (const double slowing : {1e-4, 3e-4, 1e-3}) {
      auto loop = this->settled(design);
      double last = loop.amplitude();
      for (double speed = 0.1; speed > -slowing; speed -= slowing) {
        loop.step(std::max(0.0, speed));
        // The notch gives back some of the first, larger step of the foreseen speed.
        const double echo = -design.taps[1] * design.lead_periods * slowing / 0.1;
        ASSERT_LE(loop.amplitude(), last * (1.0 + echo))
            << "slowing " << slowing << " at " << speed;
        last = loop.amplitude();
      }
    }
  }
}

TYPED_TEST(Standstill, OneWrongSampleOfTheSpeedKicksNothing) {
  for (const Design& design : designs()) {
    for (const double wrong : {0.0, 0.02, 0.05, -0.05}) {
      auto loop = this->settled(design);
      const double before = loop.amplitude();
      loop.step(wrong);
      // Of a step the foresight carries on an eighth; what is missing for a period the middle tap,
      // which is negative, gives back.
      const double kick = std::abs(wrong) == 0.05 ? 0.125 - 0.6 * design.taps[1] : 0.02;
      for (int i = 0; i < 60; ++i) {
        ASSERT_LE(loop.amplitude(), before * (1.0 + kick)) << wrong << " after " << i;
        loop.step();
      }
    }
  }
}

}  // namespace
}  // namespace sonoglide::control::standstill_test
