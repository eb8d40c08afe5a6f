/// What the vibration shows of a natural mode, against an integration of the resonator; and the
/// gains of observer and feedback, against their recursions.

#include "host_sim/configure/vibration/mode_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <random>

#include "spectral_radius.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::configure::mode_model_test {
namespace {

using tests::two_pi;

/// Displacement, velocity, and the integrals of the velocity against 2 cos and −2 sin.
using State = std::array<double, 4>;

State after_a_period(const Resonator& resonator, double amplitude, State state) {
  namespace odeint = boost::numeric::odeint;
  state[2] = 0.0;
  state[3] = 0.0;
  const auto slope = [&](const State& x, State& dx, double t) {
    dx[0] = x[1];
    dx[1] = resonator.push * amplitude * std::cos(two_pi * t) - resonator.stiffness * x[0] -
            resonator.damping * x[1];
    dx[2] = 2.0 * std::cos(two_pi * t) * x[1];
    dx[3] = -2.0 * std::sin(two_pi * t) * x[1];
  };
  const auto stepper = odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(1e-13, 1e-13);
  odeint::integrate_adaptive(stepper, slope, state, 0.0, 1.0, 1e-3);
  return state;
}

Resonator resonator(double mode_per_carrier, double damping_ratio) {
  const double natural = two_pi * mode_per_carrier;
  return {natural * natural, 2.0 * damping_ratio * natural, 30.0};
}

TEST(ModeModelTest, ForeseesWhatAnIntegrationShows) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const double mode : {0.02, 0.2163, 0.9, 1.1, 1.9999, 2.5, 3.6}) {
    for (const double damping_ratio : {0.0, 0.01, 0.5}) {
      const Resonator given = resonator(mode, damping_ratio);
      const ModeModel model = mode_model(given);
      Eigen::Vector2d free = Eigen::Vector2d::Zero();
      State state{};
      double before = 0.0;
      for (int k = 0; k < 12; ++k) {
        const double amplitude = part(generator);
        free = model.rotation * free + model.input_gain * (amplitude - before);
        state = after_a_period(given, amplitude, state);
        const Eigen::Vector2d foreseen = model.forced * amplitude + model.output * free;
        EXPECT_NEAR(foreseen(0), state[2], 1e-9) << mode << ' ' << damping_ratio << ' ' << k;
        EXPECT_NEAR(foreseen(1), state[3], 1e-9) << mode << ' ' << damping_ratio << ' ' << k;
        before = amplitude;
      }
    }
  }
}

TEST(ModeModelTest, KnowsTheMeanSquareOfTheFreeVelocity) {
  for (const double mode : {0.05, 0.7, 2.0, 3.3}) {
    for (const double damping_ratio : {0.0, 0.2}) {
      const Resonator given = resonator(mode, damping_ratio);
      const double sigma = 0.5 * given.damping;
      const std::complex<double> rate(-sigma, std::sqrt(given.stiffness - sigma * sigma));
      const Eigen::Vector2d free(0.3, -0.8);
      double sum = 0.0;
      constexpr int points = 200000;
      for (int i = 0; i < points; ++i) {
        const double velocity =
            (std::complex<double>(free(0), free(1)) * std::exp(rate * ((i + 0.5) / points))).real();
        sum += 2.0 * velocity * velocity / points;
      }
      EXPECT_NEAR(free.dot(mode_model(given).square * free), sum, 1e-8) << mode;
    }
  }
}

/// Amplitude of the drive on its way from 0 to 1.
double amplitude_at(double t, int parts) {
  return parts == 1 ? t : (std::floor(t * parts) + 0.5) / parts;
}

/// The free velocity (as in ModeModel) at the end of the period in which the amplitude comes to 1: an
/// integration less the forced motion.
std::complex<double> free_after(const Resonator& resonator, int parts) {
  namespace odeint = boost::numeric::odeint;
  using Motion = std::array<double, 2>;
  Motion motion{};
  const auto stepper =
      odeint::make_controlled<odeint::runge_kutta_fehlberg78<Motion>>(1e-13, 1e-13);
  for (int part = 0; part < parts; ++part) {
    const double begin = static_cast<double>(part) / parts;
    const auto slope = [&](const Motion& x, Motion& dx, double t) {
      const double amplitude = parts == 1 ? t : amplitude_at(begin, parts);
      dx[0] = x[1];
      dx[1] = resonator.push * amplitude * std::cos(two_pi * t) - resonator.stiffness * x[0] -
              resonator.damping * x[1];
    };
    odeint::integrate_adaptive(stepper, slope, motion, begin, begin + 1.0 / parts, 1e-3);
  }
  const std::complex<double> forced =
      resonator.push /
      std::complex<double>(resonator.stiffness - two_pi * two_pi, resonator.damping * two_pi);
  const double x = motion[0] - forced.real();
  const double v = motion[1] + two_pi * forced.imag();
  const double sigma = 0.5 * resonator.damping;
  const double rotation = std::sqrt(resonator.stiffness - sigma * sigma);
  return {v, (resonator.stiffness * x + sigma * v) / rotation};
}

TEST(ModeModelTest, ARampKicksAsAnIntegrationShows) {
  for (const double mode : {0.2163, 0.9, 1.9, 2.5, 3.02}) {
    for (const double damping_ratio : {0.0, 0.02}) {
      const Resonator given = resonator(mode, damping_ratio);
      const ModeModel model = mode_model(given);
      const double jump = (model.rotation * model.input_gain).norm();
      for (const int parts : {1, 2, 4, 8}) {
        EXPECT_NEAR(ramp_kick(given, parts), std::abs(free_after(given, parts)) / jump, 1e-9)
            << mode << ' ' << damping_ratio << ' ' << parts;
      }
    }
  }
}

TEST(ModeModelTest, ARampOfAnUndampedModeKicksByTheClosedForm) {
  for (const double a : {0.47, 0.9, 1.5, 1.9, 1.98, 2.01, 2.064, 2.5, 2.98, 3.5, 3.85, 4.003}) {
    const double mean =
        std::abs(std::sin(tests::pi * a)) * (1.0 + a * a) / (tests::pi * a * std::abs(1.0 - a * a));
    EXPECT_NEAR(ramp_kick(resonator(a, 0.0), 1), mean, 1e-12) << a;
  }
  for (const double whole : {2.0, 3.0, 4.0}) {
    EXPECT_LT(ramp_kick(resonator(whole, 0.0), 1), 1e-14);
  }
}

TEST(ModeModelTest, ItsObserverIsTheKalmanFilterOf128Periods) {
  const ModeModel model = mode_model(resonator(0.7, 0.001));
  constexpr double process = 1e-6;
  constexpr double noise = 1e-4;
  Eigen::Matrix4d dynamics = Eigen::Matrix4d::Identity();
  dynamics.topLeftCorner<2, 2>() = model.rotation;
  Eigen::Matrix<double, 2, 4> sample;
  sample << model.output, Eigen::Matrix2d::Identity();
  Eigen::Matrix4d variance = process * Eigen::Matrix4d::Identity();
  Eigen::Matrix<double, 4, 2> gain;
  for (int k = 0; k < 128; ++k) {
    gain = variance * sample.transpose() *
           (sample * variance * sample.transpose() + noise * Eigen::Matrix2d::Identity()).inverse();
    const Eigen::Matrix4d after = variance - gain * sample * variance;
    variance = dynamics * after * dynamics.transpose() + process * Eigen::Matrix4d::Identity();
  }
  const ObserverGains gains = observer_gains(model, process, noise);
  EXPECT_LT((gains.mode - gain.topRows<2>()).norm(), 1e-6 * gain.norm());
  EXPECT_LT((gains.offset - gain.bottomRows<2>()).norm(), 1e-6 * gain.norm());
}

TEST(ModeModelTest, ItsFeedbackQuietsTheModeAsFastAsItSays) {
  for (const double mode : {0.2163, 0.7, 1.3, 2.4}) {
    for (const double stability : {1.0, 1.15}) {
      const ModeModel model = mode_model(resonator(mode, 0.0));
      Eigen::Matrix3d loop = Eigen::Matrix3d::Identity();
      loop.topLeftCorner<2, 2>() = model.rotation;
      Eigen::Vector3d change;
      change << model.input_gain, 1.0;
      loop -= change * feedback_gains(model, vibration_error(model), stability);
      const double slowest = spectral_radius(loop);
      EXPECT_LT(slowest, 0.97 / stability) << mode << ' ' << stability;
    }
  }
}

// Dynamic programming over 128 periods, step by step.
TEST(ModeModelTest, ItsFeedbackIsTheLinearQuadraticOne) {
  const ModeModel model = mode_model(resonator(1.3, 0.01));
  const double price = model.forced.squaredNorm();
  Eigen::Matrix3d dynamics = Eigen::Matrix3d::Identity();
  dynamics.topLeftCorner<2, 2>() = model.rotation;
  Eigen::Vector3d change;
  change << model.input_gain, 1.0;
  Eigen::Matrix3d error;
  error << model.square, model.output.transpose() * model.forced,
      model.forced.transpose() * model.output, price;
  Eigen::Matrix3d cost = error;
  Eigen::RowVector3d gain;
  for (int k = 0; k < 128; ++k) {
    gain = change.transpose() * cost * dynamics / (price + change.dot(cost * change));
    cost = error + dynamics.transpose() * cost * (dynamics - change * gain);
  }
  EXPECT_LT((feedback_gains(model, vibration_error(model), 1.0) - gain).norm(), 1e-9 * gain.norm());
}

}  // namespace
}  // namespace sonoglide::configure::mode_model_test
