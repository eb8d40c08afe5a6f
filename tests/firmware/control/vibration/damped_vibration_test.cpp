/// The loop that damps the natural mode: what it forgoes where there is no mode to be seen, what it
/// finds wrong with its sensor, and its table between the rows. With a plant:
/// tests/acceptance/closed_loop/damping_test.cpp.

#include "firmware/control/vibration/damped_vibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>

#include "design.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "scalars.hpp"

namespace sonoglide::control::damped_vibration_test {
namespace {

constexpr double response = 0.25;  ///< velocity at full drive

/// The exponent of H/|H|²; of all other numbers 0.
template <class S>
constexpr std::uint8_t inverse_base = numeric::is_fixed_point_v<S> ? 3 : 0;

/// A plant without a mode to be seen, whose vibration follows the drive at once.
template <class S>
typename DampedVibration<S, 2>::Parameters parameters(std::uint8_t delay = 1) {
  typename DampedVibration<S, 2>::Parameters all{};
  for (ModeRow<S>& row : all.observer.table) {
    row[mode::rotation] = scaled<S>(0.5);
    row[mode::forced] = scaled<S>(response);
    row[mode::offset_gain] = scaled<S>(0.5);
    row[mode::offset_gain + 3] = scaled<S>(0.5);
    row[mode::feedback + 2] = scaled<S>(0.99);
    row[mode::inverse] = scaled<S>(std::ldexp(1.0 / response, -inverse_base<S>));
    row[mode::per_velocity] = scaled<S>(std::ldexp(1.0 / response, -inverse_base<S>));
  }
  all.observer.inverse_base = inverse_base<S>;
  all.observer.audible = scaled<S>(0.01);
  all.observer.quiet = scaled<S>(0.0);
  all.settled = scaled<S>(1e-4);
  all.missing = scaled<S>(response / 16.0);
  all.delay = delay;
  return all;
}

template <class S>
class DampedVibrationTest : public testing::Test {
 protected:
  using Loop = DampedVibration<S, 2>;

  /// One period: the sensor shows this part of the vibration.
  Fault advance(Loop& loop, double wanted, double shown = 1.0) {
    VibrationMeasurement<S> measurement{};
    measurement.in_phase = scaled<S>(shown * response * acting_);
    const Fault fault = loop.observe(measurement);
    const auto [amplitude, named] = loop.drive(scaled<S>(wanted), NoShaping<S>({}), S{});
    limit_ = named;
    acting_ = coming_;
    coming_ = numeric::to_real(amplitude);
    loop.after({amplitude, {}, {}, {}, {}, {}});
    return fault;
  }

  double acting_ = 0.0;
  double coming_ = 0.0;
  Limit limit_ = Limit::none;
};
TYPED_TEST_SUITE(DampedVibrationTest, Scalars);

TYPED_TEST(DampedVibrationTest, BringsTheVibrationToItsVelocity) {
  const auto nominal = parameters<TypeParam>();
  typename TestFixture::Loop loop(nominal);
  for (const double wanted : {0.1, 0.2, 0.02}) {
    for (int k = 0; k < 12; ++k) {
      EXPECT_EQ(this->advance(loop, wanted), Fault::none);
    }
    EXPECT_NEAR(response * this->acting_, wanted, 1e-4 * wanted);
    EXPECT_TRUE(loop.settled());
    EXPECT_EQ(this->limit_, Limit::none);
  }
}

TYPED_TEST(DampedVibrationTest, LearnsWhatTheModelLeavesOut) {
  const auto nominal = parameters<TypeParam>();
  typename TestFixture::Loop loop(nominal);
  for (int k = 0; k < 60; ++k) {
    this->advance(loop, 0.1, 0.8);
  }
  EXPECT_NEAR(0.8 * response * this->acting_, 0.1, 1e-5);
}

TYPED_TEST(DampedVibrationTest, NamesAVelocityOutOfReach) {
  const auto nominal = parameters<TypeParam>();
  typename TestFixture::Loop loop(nominal);
  for (int k = 0; k < 12; ++k) {
    this->advance(loop, 0.3);
  }
  EXPECT_EQ(this->limit_, Limit::actuator);
  EXPECT_TRUE(loop.at_most());
  EXPECT_NEAR(this->acting_, 1.0, 1e-3);
}

TYPED_TEST(DampedVibrationTest, GivesNoDriveForNoVibration) {
  const auto nominal = parameters<TypeParam>();
  typename TestFixture::Loop loop(nominal);
  for (int k = 0; k < 12; ++k) {
    this->advance(loop, 0.1);
  }
  for (int k = 0; k < 12; ++k) {
    this->advance(loop, 0.0);
  }
  EXPECT_EQ(this->coming_, 0.0);
  EXPECT_EQ(this->limit_, Limit::none);
}

TYPED_TEST(DampedVibrationTest, MissesADeadSensor) {
  const auto nominal = parameters<TypeParam>();
  typename TestFixture::Loop loop(nominal);
  // The latency, and the first commands below a quarter.
  constexpr int at_most = TestFixture::Loop::missing_samples + 4;
  int periods = 0;
  while (this->advance(loop, 0.2, 0.0) == Fault::none && periods < 100) {
    ++periods;
  }
  EXPECT_GE(periods, TestFixture::Loop::missing_samples);
  EXPECT_LE(periods, at_most);
}

TYPED_TEST(DampedVibrationTest, DisbelievesAVibrationThatTheDriveDoesNotMove) {
  const auto nominal = parameters<TypeParam>();
  typename TestFixture::Loop loop(nominal);
  VibrationMeasurement<TypeParam> stuck{};
  stuck.quadrature = scaled<TypeParam>(0.24);
  Fault fault = Fault::none;
  int periods = 0;
  for (; periods < 200 && fault == Fault::none; ++periods) {
    fault = loop.observe(stuck);
    loop.after({scaled<TypeParam>(0.4), {}, {}, {}, {}, {}});
  }
  EXPECT_EQ(fault, Fault::resonance_lost);
  EXPECT_LE(periods, TestFixture::Loop::lost_samples + 8);
}

TYPED_TEST(DampedVibrationTest, CountsFromTheCommandThatWasInForce) {
  for (std::uint8_t delay = 0; delay <= 2; ++delay) {
    const auto nominal = parameters<TypeParam>(delay);
    DampedVibration<TypeParam, 2> loop(nominal);
    double line[4] = {};  // the command in force, then those under way
    for (int k = 0; k < 20; ++k) {
      VibrationMeasurement<TypeParam> measurement{};
      measurement.in_phase = scaled<TypeParam>(response * line[0]);
      loop.observe(measurement);
      const auto [amplitude, named] =
          loop.drive(scaled<TypeParam>(0.1), NoShaping<TypeParam>({}), TypeParam{});
      loop.after({amplitude, {}, {}, {}, {}, {}});
      line[delay + 1] = numeric::to_real(amplitude);
      for (int i = 0; i <= delay; ++i) {
        line[i] = line[i + 1];
      }
      // Without a mode the very first answer is right, and so are all others.
      EXPECT_NEAR(line[delay], 0.4, k == 0 ? 5e-3 : 1e-4) << int{delay} << ' ' << k;
    }
  }
}

TYPED_TEST(DampedVibrationTest, ItsTableIsLinearBetweenTheRows) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> entry(-0.49, 0.49);
  ModeTable<double> reference{};
  ModeTable<TypeParam> table{};
  for (std::size_t row = 0; row < mode::rows; ++row) {
    for (std::size_t i = 0; i < mode::numbers; ++i) {
      table[row][i] =
          scaled<TypeParam>(i < mode::sloped ? entry(generator) / 8.0 : entry(generator));
      reference[row][i] = numeric::to_real(table[row][i]);
    }
  }
  ModeInterpolation<TypeParam> frequency_parameter;
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  for (int k = 0; k < 1000; ++k) {
    const TypeParam at = k == 0   ? scaled<TypeParam>(-1.0)
                         : k == 1 ? numeric::from_code<TypeParam>(INT32_MAX - 1)
                                  : scaled<TypeParam>(anywhere(generator));
    frequency_parameter.go(table, at);
    const double rows = 8.0 * (numeric::to_real(at) + 1.0);
    const auto low = std::min<std::size_t>(mode::rows - 2, static_cast<std::size_t>(rows));
    for (std::size_t i = 0; i < mode::numbers; ++i) {
      const double rise = reference[low + 1][i] - reference[low][i];
      const double exact = reference[low][i] + rise * (rows - static_cast<double>(low));
      EXPECT_NEAR(numeric::to_real(frequency_parameter[i]), exact,
                  0x1p-27 * std::abs(rise) + 4.0 * resolution<TypeParam>())
          << rows;
      if (i < mode::sloped) {
        EXPECT_NEAR(numeric::to_real(frequency_parameter.slope(i)), 8.0 * rise,
                    8.0 * resolution<TypeParam>());
      }
    }
  }
}

/// The same in a controller, over a Coulomb contact.
template <class S>
class DampedController : public testing::Test {
 protected:
  using Composed = Parts<S, TrustedFriction<S>, CoulombFeedforward<S>, NoSlewLimit<S>, NoShaping<S>,
                         IntegralRegulator<S, 2>, NoRelearning<S>, DampedVibration<S, 2>,
                         ForceSensor, RatioTarget<S>, DriveLimit<S>>;

  void begin(double drive_limit) {
    Design design;
    design.drive_limit = drive_limit;
    all_ = control::parameters<Composed>(design);
    all_.vibration = parameters<S>();
    controller_.emplace(all_);
    controller_->start();
    controller_->set_target(scaled<S>(0.25));
  }

  /// One period: the vibration sensor shows this part of the vibration.
  void step(double shown = 1.0) {
    constexpr double speed = 0.1;
    const double velocity = response * acting_;
    ratio_ = speed < velocity ? std::asin(speed / velocity) / std::asin(1.0) : 1.0;
    VibrationMeasurement<S> measurement{};
    measurement.friction_force = scaled<S>(0.5 * ratio_);
    measurement.sliding_velocity = scaled<S>(speed);
    measurement.in_phase = scaled<S>(shown * velocity);
    acting_ = coming_;
    command_ = controller_->step(measurement);
    coming_ = numeric::to_real(command_.amplitude);
  }

  typename Controller<Composed>::Parameters all_{};
  std::optional<Controller<Composed>> controller_;
  DriveCommand<S> command_{};
  double acting_ = 0.0;
  double coming_ = 0.0;
  double ratio_ = 1.0;
};
TYPED_TEST_SUITE(DampedController, Scalars);

TYPED_TEST(DampedController, ReachesItsTarget) {
  this->begin(0.99);
  for (int k = 0; k < 400; ++k) {
    this->step();
  }
  EXPECT_NEAR(this->ratio_, 0.5, 1e-3);
  EXPECT_EQ(this->command_.state, State::running);
  EXPECT_EQ(this->command_.settling, Settling::settled);
  this->controller_->start();  // goes on with what it knows of its drive
  for (int k = 0; k < 100; ++k) {
    this->step();
  }
  EXPECT_NEAR(this->ratio_, 0.5, 1e-3);
}

TYPED_TEST(DampedController, KeepsToTheLimitOfItsDriveAndNamesIt) {
  this->begin(0.45);
  for (int k = 0; k < 200; ++k) {
    this->step();
    ASSERT_LE(this->coming_, 0.45 + 1e-6);
  }
  EXPECT_NEAR(this->coming_, 0.45, 1e-6);
  EXPECT_EQ(this->command_.limit, Limit::actuator);
}

TYPED_TEST(DampedController, IsInAFaultWithoutASignOfTheVibrationUntilItIsStartedAgain) {
  this->begin(0.99);
  int periods = 0;
  while (this->command_.fault == Fault::none && periods < 100) {
    this->step(0.0);
    ++periods;
  }
  EXPECT_EQ(this->command_.fault, Fault::vibration_missing);
  EXPECT_LE(periods, TestFixture::Composed::Vibration::missing_samples + 8);
  EXPECT_EQ(this->coming_, 0.0);
  this->step();
  EXPECT_EQ(this->command_.state, State::fault);
  this->controller_->start();
  for (int k = 0; k < 400; ++k) {
    this->step();
  }
  EXPECT_NEAR(this->ratio_, 0.5, 1e-3);
}

}  // namespace
}  // namespace sonoglide::control::damped_vibration_test
