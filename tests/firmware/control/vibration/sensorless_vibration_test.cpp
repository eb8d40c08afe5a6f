/// What the loop without a vibration sensor takes of a sample, and its drive. With a plant:
/// tests/acceptance/closed_loop/damping_test.cpp.
#include "firmware/control/vibration/sensorless_vibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "firmware/control/friction/coulomb_feedforward.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "vibration/sensorless_design.hpp"

namespace sonoglide::control::sensorless_vibration_test {
namespace {

template <class S>
class SensorlessVibrationTest : public testing::Test {
 protected:
  using Loop = SensorlessVibration<S, 2, PromptReading<S>>;
  static constexpr std::uint8_t inverse_base = numeric::is_fixed_point_v<S> ? 3 : 0;

  static typename Loop::Parameters parameters() {
    typename Loop::Parameters all{};
    all.observer = sensorless_design::parameters<S>(0.001);
    for (auto& row : all.observer.table) {
      row[SensorlessIndex::per_velocity] =
          scaled<S>(std::ldexp(1.0 / sensorless_design::forced, -inverse_base));
      row[SensorlessIndex::feedback + 2] = scaled<S>(0.99);
    }
    all.observer.inverse_base = inverse_base;
    all.delay = 1;
    return all;
  }

  /// One period, with a friction ratio of a half.
  static Request<S> advance(Loop& loop, double wanted, double sliding, bool backwards,
                            double ceiling = 0.99) {
    loop.before();
    loop.sense(scaled<S>(0.25), scaled<S>(sliding), backwards, CoulombFeedforward<S>({}));
    const Request<S> driven = loop.drive(scaled<S>(wanted), NoShaping<S>({}), scaled<S>(ceiling));
    loop.after({driven.amplitude, {}, {}, {}, {}, {}});
    return driven;
  }
};
TYPED_TEST_SUITE(SensorlessVibrationTest, Scalars);

/// A reading at rest or against the direction of the table changes no bit of the drive.
TYPED_TEST(SensorlessVibrationTest, TakesReadingsOfItsDirectionAlone) {
  const auto nominal = this->parameters();
  typename TestFixture::Loop unread(nominal);
  typename TestFixture::Loop against(nominal);
  typename TestFixture::Loop along(nominal);
  bool differs = false;
  for (int k = 0; k < 40; ++k) {
    const auto expected = this->advance(unread, 0.15, 0.0, false).amplitude;
    ASSERT_EQ(this->advance(against, 0.15, 0.09, true).amplitude, expected) << k;
    differs = differs || this->advance(along, 0.15, 0.09, false).amplitude != expected;
  }
  EXPECT_TRUE(differs);
}

TYPED_TEST(SensorlessVibrationTest, KeepsToItsCeilingAndNamesIt) {
  const auto nominal = this->parameters();
  typename TestFixture::Loop loop(nominal);
  Request<TypeParam> driven{};
  for (int k = 0; k < 20; ++k) {
    driven = this->advance(loop, 0.15, 0.0, false, 0.125);
  }
  EXPECT_EQ(driven.amplitude, scaled<TypeParam>(0.125));
  EXPECT_EQ(driven.limit, Limit::actuator);
}

TYPED_TEST(SensorlessVibrationTest, ImpliesTheRatioOfTheVelocityOfItsSteadyDrive) {
  const auto nominal = this->parameters();
  typename TestFixture::Loop loop(nominal);
  for (int k = 0; k < 20; ++k) {
    this->advance(loop, 0.15, 0.0, false);
  }
  const auto same = [](TypeParam velocity) { return velocity; };
  EXPECT_NEAR(numeric::to_real(loop.implied_ratio(scaled<TypeParam>(0.3), same)), 0.15, 0.01);
  loop.restart(true);
  EXPECT_EQ(this->advance(loop, 0.0, 0.0, false).amplitude, TypeParam{});
}

}  // namespace
}  // namespace sonoglide::control::sensorless_vibration_test
