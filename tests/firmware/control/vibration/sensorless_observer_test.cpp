/// The observer of a mode that is felt in one number a period: the mode that it finds, and the natural
/// frequency against the Cramér–Rao bound. With a plant: tests/acceptance/closed_loop/damping_test.cpp.

#include "firmware/control/vibration/sensorless_observer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <random>

#include "scalars.hpp"
#include "vibration/sensorless_design.hpp"

namespace sonoglide::control::sensorless_observer_test {
namespace {

using sensorless_design::amplitude;
using sensorless_design::angle;
using sensorless_design::forced;
using sensorless_design::input_gain;
using sensorless_design::output;
using sensorless_design::parameters;
using sensorless_design::per_frequency_parameter;
using sensorless_design::speed;

/// What the observer is told of a mode that turns by its own angle.
template <class S>
struct Ringing {
  SensorlessObserver<S>& observer;
  double angle;
  std::complex<double> mode;
  double before = amplitude;

  void pass(double now, double offset, double noise) {
    const double change = now - before;
    mode = mode * std::polar(1.0, angle) + std::complex<double>(0.0, input_gain * change);
    observer.predict(scaled<S>(change));
    const double velocity = forced * now + offset + output * mode.real() + noise;
    observer.observe(scaled<S>(velocity), scaled<S>(speed),
                     {scaled<S>(now), scaled<S>(before), scaled<S>(before)}, scaled<S>(0.5));
    before = now;
  }
};

template <class S>
class SensorlessObserverTest : public testing::Test {};
TYPED_TEST_SUITE(SensorlessObserverTest, Scalars);

TYPED_TEST(SensorlessObserverTest, FindsAModeThatRingsAlready) {
  const auto nominal = parameters<TypeParam>(0.001);
  SensorlessObserver<TypeParam> observer(nominal);
  Ringing<TypeParam> ringing{observer, angle(0.0), {0.03, -0.05}};
  for (int k = 0; k < 60; ++k) {
    ringing.pass(amplitude, 0.01, 0.0);
  }
  EXPECT_NEAR(numeric::to_real(observer.mode().first), ringing.mode.real(), 0.002);
  EXPECT_NEAR(numeric::to_real(observer.mode().second), ringing.mode.imag(), 0.002);
}

TYPED_TEST(SensorlessObserverTest, ForeseesWhatAChangeOfTheAmplitudeKicks) {
  const auto nominal = parameters<TypeParam>(0.001);
  SensorlessObserver<TypeParam> observer(nominal);
  Ringing<TypeParam> ringing{observer, angle(0.0), {}};
  ringing.pass(0.9, 0.0, 0.0);
  EXPECT_NEAR(numeric::to_real(observer.mode().second), input_gain * 0.3, 1e-6);
  for (int k = 0; k < 10; ++k) {
    ringing.pass(0.9, 0.0, 0.0);
    EXPECT_NEAR(numeric::to_real(observer.mode().first), ringing.mode.real(), 1e-5) << k;
  }
  EXPECT_NEAR(numeric::to_real(observer.frequency_parameter()), 0.0, 1e-5);
}

// A reading is a mean over its period, and of a contact that is led: it shows the last two changes of the
// amplitude themselves, and both coordinates of the mode.
TYPED_TEST(SensorlessObserverTest, ForeseesWhatTheLastTwoChangesShowAtOnce) {
  constexpr double second = 0.1;
  constexpr double last_change = 0.2;
  constexpr double change_before = -0.15;
  auto nominal = parameters<TypeParam>(0.001);
  for (SensorlessRow<TypeParam>& row : nominal.table) {
    for (std::size_t node = 0; node < SensorlessIndex::nodes; ++node) {
      TypeParam* const numbers = &row[SensorlessIndex::plain + node * SensorlessIndex::Node::count];
      numbers[SensorlessIndex::Node::output + 1] = scaled<TypeParam>(second);
      numbers[SensorlessIndex::Node::last_change] = scaled<TypeParam>(last_change);
      numbers[SensorlessIndex::Node::change_before] = scaled<TypeParam>(change_before);
    }
  }
  SensorlessObserver<TypeParam> observer(nominal);
  std::complex<double> mode;
  double before = amplitude;
  double earlier = amplitude;
  for (int k = 0; k < 30; ++k) {
    const double now = amplitude + 0.1 * ((5 * k + 3) % 4);
    const double change = now - before;
    mode = mode * std::polar(1.0, angle(0.0)) + std::complex<double>(0.0, input_gain * change);
    observer.predict(scaled<TypeParam>(change));
    const double velocity = forced * now + output * mode.real() + second * mode.imag() +
                            last_change * change + change_before * (before - earlier);
    observer.observe(
        scaled<TypeParam>(velocity), scaled<TypeParam>(speed),
        {scaled<TypeParam>(now), scaled<TypeParam>(before), scaled<TypeParam>(earlier)},
        scaled<TypeParam>(0.5));
    EXPECT_NEAR(numeric::to_real(observer.mode().first), mode.real(), 1e-5) << k;
    EXPECT_NEAR(numeric::to_real(observer.mode().second), mode.imag(), 1e-5) << k;
    earlier = before;
    before = now;
  }
  EXPECT_NEAR(numeric::to_real(observer.frequency_parameter()), 0.0, 1e-4);
}

TYPED_TEST(SensorlessObserverTest, FindsTheNaturalFrequencyOfWhatItKicks) {
  for (const double frequency_parameter : {-0.8, -0.3, 0.5, 0.9}) {
    const auto nominal = parameters<TypeParam>(0.0005);
    SensorlessObserver<TypeParam> observer(nominal);
    Ringing<TypeParam> ringing{observer, angle(frequency_parameter), {}};
    for (int k = 0; k < 200; ++k) {
      ringing.pass(k / 20 % 2 == 0 ? 0.6 : 0.9, 0.0, 0.0);
    }
    EXPECT_NEAR(numeric::to_real(observer.frequency_parameter()), frequency_parameter, 0.05);
  }
}

/// A quiet mode tells nothing of its frequency: in noise it stays within a third of its first doubt.
TYPED_TEST(SensorlessObserverTest, LeavesTheFrequencyOfAQuietModeAlone) {
  constexpr double noise = 0.002;
  constexpr int runs = 50;
  const auto nominal = parameters<TypeParam>(noise);
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal(0.0, noise);
  double squares = 0.0;
  for (int run = 0; run < runs; ++run) {
    SensorlessObserver<TypeParam> observer(nominal);
    Ringing<TypeParam> ringing{observer, angle(0.0), {}};
    for (int k = 0; k < 500; ++k) {
      ringing.pass(amplitude, 0.0, normal(generator));
    }
    squares += numeric::to_real(observer.frequency_parameter()) *
               numeric::to_real(observer.frequency_parameter());
  }
  EXPECT_LT(std::sqrt(squares / runs), 0.15);
}

/// At a velocity below that of the sliding friction shows nothing.
TYPED_TEST(SensorlessObserverTest, FeelsNothingBelowTheSpeedOfTheSliding) {
  const auto nominal = parameters<TypeParam>(0.001);
  SensorlessObserver<TypeParam> observer(nominal);
  observer.predict({});
  const TypeParam weak = scaled<TypeParam>(0.3);  // 0.075 of velocity
  observer.observe(scaled<TypeParam>(0.3), scaled<TypeParam>(speed), {weak, weak, weak},
                   scaled<TypeParam>(0.5));
  EXPECT_EQ(numeric::to_real(observer.mode().first), 0.0);
}

/// Friction no longer follows a mode of that size linearly.
TYPED_TEST(SensorlessObserverTest, BelievesNoReadingOfAModeThatIsTooLarge) {
  for (const bool large : {false, true}) {
    auto nominal = parameters<TypeParam>(0.001);
    nominal.linear = {scaled<TypeParam>(0.5), large ? -2 : 3};  // of a velocity of 0.225
    SensorlessObserver<TypeParam> observer(nominal);
    observer.predict(scaled<TypeParam>(0.9));
    const Pair<TypeParam> before = observer.mode();
    const TypeParam now = scaled<TypeParam>(0.9);
    observer.observe(scaled<TypeParam>(0.3), scaled<TypeParam>(speed), {now, now, now},
                     scaled<TypeParam>(0.5));
    EXPECT_EQ(observer.mode().first == before.first, large);
  }
}

/// A mode that no reading shows, and by which a feedback might keep the drive down for ever.
TYPED_TEST(SensorlessObserverTest, ForgetsAModeThatNothingShows) {
  const auto nominal = parameters<TypeParam>(0.001);
  SensorlessObserver<TypeParam> observer(nominal);
  observer.predict(scaled<TypeParam>(0.9));
  const double kicked = numeric::to_real(observer.mode().second);
  ASSERT_NEAR(kicked, 0.9 * input_gain, 1e-6);
  for (int k = 0; k < 32; ++k) {
    observer.observe(scaled<TypeParam>(0.1), scaled<TypeParam>(speed), {}, scaled<TypeParam>(0.5));
  }
  EXPECT_NEAR(numeric::to_real(observer.mode().second), kicked * std::pow(31.0 / 32.0, 32), 1e-6);
}

// Numbers of the table that are on a base stand there divided by it, in fixed point only.
TYPED_TEST(SensorlessObserverTest, FeedbackAndAmplitudesAreThoseOfTheTable) {
  auto nominal = parameters<TypeParam>(0.001);
  nominal.feedback_base = 1;
  nominal.inverse_base = 3;
  for (SensorlessRow<TypeParam>& row : nominal.table) {
    row[SensorlessIndex::feedback] = scaled<TypeParam>(0.25);
    row[SensorlessIndex::feedback + 1] = scaled<TypeParam>(-0.125);
    row[SensorlessIndex::feedback + 2] = scaled<TypeParam>(0.0625);
    row[SensorlessIndex::per_velocity] = scaled<TypeParam>(0.5);
  }
  const SensorlessObserver<TypeParam> observer(nominal);
  const double base = numeric::is_fixed_point_v<TypeParam> ? 2.0 : 1.0;
  const Pair<TypeParam> mode{scaled<TypeParam>(0.2), scaled<TypeParam>(0.3)};
  EXPECT_NEAR(numeric::to_real(observer.feedback(mode, scaled<TypeParam>(0.4))),
              base * (0.25 * 0.2 - 0.125 * 0.3 + 0.0625 * 0.4), 1e-6);
  EXPECT_NEAR(numeric::to_real(observer.nominal_velocity(scaled<TypeParam>(0.4))), forced * 0.4,
              1e-6);
  EXPECT_NEAR(numeric::to_real(observer.quarter_amplitude(scaled<TypeParam>(0.2))),
              (numeric::is_fixed_point_v<TypeParam> ? 8.0 : 1.0) * 0.5 * 0.2 / 4.0, 1e-6);
}

/// Of the place, after so many periods of a mode that was kicked from rest: the observer knows the kick
/// and about where the place is, which the bound below does not.
double rms_of_frequency(double frequency_parameter, double noise, int periods, int runs) {
  const auto nominal = parameters<double>(noise);
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal(0.0, noise);
  double squares = 0.0;
  for (int run = 0; run < runs; ++run) {
    SensorlessObserver<double> observer(nominal);
    Ringing<double> ringing{observer, angle(frequency_parameter), {}};
    for (int k = 0; k < periods; ++k) {
      ringing.pass(1.0, 0.0, normal(generator));
    }
    const double error = observer.frequency_parameter() - frequency_parameter;
    squares += error * error;
  }
  return std::sqrt(squares / runs);
}

/// Least standard deviation of an unbiased estimate of the angle of a sinusoid of unknown amplitude and
/// phase: var ≥ 12/(η n (n² − 1)), η = A²/2σ² (Rife and Boorstyn 1974), over the angle of a place.
double bound_of_frequency(double noise, int periods) {
  const double heard = output * input_gain * (1.0 - amplitude);
  const double ratio = heard * heard / (2.0 * noise * noise);
  const double n = periods;
  return std::sqrt(12.0 / (ratio * n * (n * n - 1.0))) / per_frequency_parameter;
}

/// Below a noise of a hundredth of the sliding velocity the doubt about the map is larger.
TEST(SensorlessObserverTest, ItsFrequencyIsNearTheCramerRaoBound) {
  for (const double noise : {0.01, 0.02, 0.04}) {
    for (const int periods : {24, 40, 80}) {
      EXPECT_LT(rms_of_frequency(0.3, noise * speed, periods, 400),
                1.4 * bound_of_frequency(noise * speed, periods))
          << noise << ", " << periods;
    }
  }
}

/// As one that is at least 0.3 of the sliding velocity above the forecast.
TYPED_TEST(SensorlessObserverTest, AReadingBeyondAllVelocitiesMovesItByNoMoreThanTheMost) {
  const auto nominal = parameters<TypeParam>(0.001);
  SensorlessObserver<TypeParam> beyond(nominal);
  SensorlessObserver<TypeParam> far(nominal);
  const PastAmplitudes<TypeParam> steady{scaled<TypeParam>(amplitude), scaled<TypeParam>(amplitude),
                                         scaled<TypeParam>(amplitude)};
  for (int k = 0; k < 5; ++k) {
    beyond.predict(TypeParam{});
    far.predict(TypeParam{});
    beyond.observe(numeric::from_code<TypeParam>(INT32_MAX), scaled<TypeParam>(speed), steady,
                   scaled<TypeParam>(0.5));
    far.observe(scaled<TypeParam>(0.5), scaled<TypeParam>(speed), steady, scaled<TypeParam>(0.5));
    ASSERT_EQ(beyond.mode().first, far.mode().first);
    ASSERT_EQ(beyond.mode().second, far.mode().second);
  }
  EXPECT_NE(beyond.mode().first, TypeParam{});
}

TYPED_TEST(SensorlessObserverTest, ForgetsTheModeWhereTheVibrationWasSlowerThanTheSliding) {
  const auto nominal = parameters<TypeParam>(0.001);
  SensorlessObserver<TypeParam> observer(nominal);
  Ringing<TypeParam> ringing{observer, angle(0.0), {0.03, -0.05}};
  for (int k = 0; k < 60; ++k) {
    ringing.pass(amplitude, 0.0, 0.0);
  }
  const double mode =
      std::hypot(numeric::to_real(observer.mode().first), numeric::to_real(observer.mode().second));
  const auto slow = scaled<TypeParam>(0.2);  // half the sliding velocity
  observer.observe(scaled<TypeParam>(0.3), scaled<TypeParam>(speed),
                   {scaled<TypeParam>(amplitude), slow, slow}, scaled<TypeParam>(0.5));
  EXPECT_NEAR(
      std::hypot(numeric::to_real(observer.mode().first), numeric::to_real(observer.mode().second)),
      31.0 / 32.0 * mode, 1e-6);
}

/// Below a velocity ratio of 1/8 its table is that of 1/8.
TYPED_TEST(SensorlessObserverTest, FindsAModeAtASlowSliding) {
  const auto nominal = parameters<TypeParam>(0.001);
  SensorlessObserver<TypeParam> observer(nominal);
  std::complex<double> mode(0.003, -0.005);
  for (int k = 0; k < 200; ++k) {
    mode *= std::polar(1.0, angle(0.0));
    observer.predict(TypeParam{});
    const auto now = scaled<TypeParam>(amplitude);
    observer.observe(scaled<TypeParam>(forced * amplitude + output * mode.real()),
                     scaled<TypeParam>(0.01), {now, now, now}, scaled<TypeParam>(0.5));
  }
  EXPECT_NEAR(numeric::to_real(observer.mode().first), mode.real(), 0.001);
  EXPECT_NEAR(numeric::to_real(observer.mode().second), mode.imag(), 0.001);
}

}  // namespace
}  // namespace sonoglide::control::sensorless_observer_test
