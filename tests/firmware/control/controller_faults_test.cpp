/// Faults: the drive is gone in the very step, the cause stays, an explicit start makes afresh.

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "closed_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::controller_faults_test {
namespace {

template <class Scalar>
struct BadSample {
  std::string name;
  Measurement<Scalar> measurement;
  Fault fault;
};

template <class Scalar>
std::vector<BadSample<Scalar>> bad_samples() {
  const auto force = scaled<Scalar>(0.2);
  const auto velocity = scaled<Scalar>(0.1);
  std::vector<BadSample<Scalar>> result = {
      {"missing", {force, velocity, Quality::missing}, Fault::measurement_missing},
      {"saturated", {force, velocity, Quality::saturated}, Fault::measurement_saturated}};
  if constexpr (!numeric::is_fixed_point_v<Scalar>) {
    constexpr Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    constexpr Fault not_finite = Fault::measurement_not_finite;
    result.push_back({"force NaN", {nan, velocity, Quality::good}, not_finite});
    result.push_back({"force +inf", {infinity, velocity, Quality::good}, not_finite});
    result.push_back({"force -inf", {-infinity, velocity, Quality::good}, not_finite});
    result.push_back({"velocity NaN", {force, nan, Quality::good}, not_finite});
    result.push_back({"velocity +inf", {force, infinity, Quality::good}, not_finite});
    result.push_back({"velocity -inf", {force, -infinity, Quality::good}, not_finite});
  }
  return result;
}

template <class Scalar>
bool same(const DriveCommand<Scalar>& a, const DriveCommand<Scalar>& b) {
  return a.amplitude == b.amplitude && a.commanded_ratio == b.commanded_ratio &&
         a.state == b.state && a.limit == b.limit && a.fault == b.fault && a.settling == b.settling;
}

/// Falls below the speed floor, reverses, rises again.
double scripted_velocity(int i) {
  const double velocity = i < 300 ? 0.15 : 0.15 - 0.0015 * (i - 300);
  return velocity < -0.15 ? -0.15 : velocity;
}

template <class PartsT>
void expect_like_new(Controller<PartsT>& used, double target, const std::string& after) {
  ClosedLoop<PartsT> fresh({});
  fresh.set_target(target);
  used.start();
  for (int i = 0; i < 600; ++i) {
    const double noise = 0.001 * ((i * 37) % 11 - 5);
    const auto sample = fresh.measurement(scripted_velocity(i), noise);
    ASSERT_TRUE(same(used.step(sample), fresh.answer(sample))) << after << ", step " << i;
  }
}

template <class Scalar>
class ControllerFaults : public testing::Test {
 protected:
  static constexpr int calibration = 60;

  static void expect_gone(const DriveCommand<Scalar>& command, Fault fault,
                          const std::string& when) {
    EXPECT_EQ(command.amplitude, Scalar{}) << when;
    EXPECT_EQ(command.state, State::fault) << when;
    EXPECT_EQ(command.limit, Limit::none) << when;
    EXPECT_EQ(command.fault, fault) << when;
  }
};
TYPED_TEST_SUITE(ControllerFaults, Scalars);

TYPED_TEST(ControllerFaults, TakeTheDriveAwayAtOnceAndKeepTheirCause) {
  for (const auto& bad : bad_samples<TypeParam>()) {
    for (const int good_before : {0, 1, this->calibration, 200}) {
      ClosedLoop<FullParts<TypeParam>> loop({});
      loop.set_target(0.4);
      loop.run(good_before);
      this->expect_gone(loop.answer(bad.measurement), bad.fault, bad.name);
      for (int i = 0; i < 100; ++i) {
        this->expect_gone(loop.step(), bad.fault, bad.name + ", good samples after it");
      }
      for (const auto& other : bad_samples<TypeParam>()) {
        this->expect_gone(loop.answer(other.measurement), bad.fault, bad.name + " was first");
      }
    }
  }
}

TYPED_TEST(ControllerFaults, AreForgottenByAnExplicitStart) {
  constexpr double target = 0.4;
  for (const auto& bad : bad_samples<TypeParam>()) {
    ClosedLoop<FullParts<TypeParam>> full({});
    full.set_target(target);
    full.run(317, -0.13);
    full.answer(bad.measurement);
    expect_like_new(full.controller, target, bad.name);

    ClosedLoop<ShapedParts<TypeParam>> shaped({});
    shaped.set_target(target);
    shaped.run(317, -0.13);
    shaped.answer(bad.measurement);
    expect_like_new(shaped.controller, target, bad.name);
  }
}

TYPED_TEST(ControllerFaults, AStartAfterAStopIsLikeNewToo) {
  constexpr double target = 0.4;
  ClosedLoop<FullParts<TypeParam>> loop({});
  loop.set_target(target);
  loop.run(123);
  loop.controller.stop();
  expect_like_new(loop.controller, target, "stop");
}

/// Steps until the controller trips on a reading that never changes while the target toggles.
template <class PartsT>
int steps_until_stuck(Controller<PartsT>& controller) {
  using Scalar = typename PartsT::Scalar;
  for (int i = 1; i <= 1000; ++i) {
    controller.set_target(numeric::from_real<Scalar>(i % 2 == 0 ? 0.1 : 0.3));
    const auto command = controller.step({scaled<Scalar>(0.2), scaled<Scalar>(0.1), Quality::good});
    if (command.fault != Fault::none) {
      EXPECT_EQ(command.fault, Fault::measurement_stuck);
      EXPECT_EQ(command.amplitude, Scalar{});
      return i;
    }
  }
  return -1;
}

TYPED_TEST(ControllerFaults, AReadingThatIgnoresTheDriveIsStuck) {
  const Design design;
  Controller<UnshapedParts<TypeParam>> controller(parameters<UnshapedParts<TypeParam>>(design));
  controller.start();
  const int steps = steps_until_stuck(controller);
  EXPECT_GE(steps, design.stuck_periods);
  EXPECT_LE(steps, design.stuck_periods + 5);  // a few until the drive has moved by a quarter
}

TYPED_TEST(ControllerFaults, AStuckReadingIsGivenTheSameTimeAfterARestart) {
  Controller<UnshapedParts<TypeParam>> controller(parameters<UnshapedParts<TypeParam>>(Design{}));
  controller.start();
  const int first = steps_until_stuck(controller);
  controller.start();
  EXPECT_EQ(steps_until_stuck(controller), first);
}

TYPED_TEST(ControllerFaults, ASettledReadingIsNotStuck) {
  ClosedLoop<ShapedParts<TypeParam>> loop({});
  loop.set_target(0.4);
  for (int i = 0; i < 20'000; ++i) {
    ASSERT_EQ(loop.step().fault, Fault::none) << "step " << i;
  }
}

// The undriven friction is exactly Fc, sample after sample; the first drive shows in the reading
// only after the sensor's delay.
TYPED_TEST(ControllerFaults, ADelayedReadingIsNotStuck) {
  Design design;
  design.gain = 0.05;
  design.hold_periods = 12;
  design.stuck_periods = 18;
  for (const std::size_t delay : {1U, 3U, 7U}) {
    ClosedLoop<LearningParts<TypeParam>> loop(design);
    loop.delay_sensor(delay);
    loop.set_target(0.2);
    for (int i = 0; i < 600; ++i) {
      if (i == 300) {
        loop.set_target(1.0);
      } else if (i == 400) {
        loop.set_target(0.15);
      }
      ASSERT_EQ(loop.step().fault, Fault::none) << "delay " << delay << " step " << i;
    }
    EXPECT_NEAR(loop.ratio(), 0.15, 1e-3);
  }
}

}  // namespace
}  // namespace sonoglide::control::controller_faults_test
