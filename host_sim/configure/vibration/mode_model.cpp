#include "host_sim/configure/vibration/mode_model.hpp"

#include <Eigen/LU>
#include <complex>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/vibration/complex_exponential.hpp"

namespace sonoglide::configure {
namespace {

using Complex = std::complex<double>;

constexpr Complex j{0.0, 1.0};

Eigen::Vector2d parts(Complex z) {
  return {z.real(), z.imag()};
}

/// What X = A' X (I + B B' X)^-1 A + Q leads to from X = Q in 128 carrier periods, by the doubling
/// algorithm (Chu, Fan, Lin and Wang 2004): each turn does as many steps as all before it. In that
/// time a target is long settled; more would only let the covariance grow by what a mode
/// next to a multiple of the carrier never shows.
template <class Matrix>
Matrix riccati(Matrix a, Matrix b_squared, const Matrix& q) {
  constexpr int doublings = 7;
  Matrix x = q;
  for (int i = 0; i < doublings; ++i) {
    const Matrix inverse = (Matrix::Identity() + b_squared * x).inverse();
    const Matrix step = inverse * a;
    const Matrix x_next = x + a.transpose() * x * step;
    b_squared += a * inverse * b_squared * a.transpose();
    a *= step;
    x = 0.5 * (x_next + x_next.transpose());
  }
  return x;
}

constexpr double omega = numeric::two_pi;

/// X of the steady vibration Re(X e^{jωt}) at full drive.
Complex forced_displacement(const Resonator& resonator) {
  return resonator.push / Complex(resonator.stiffness - omega * omega, resonator.damping * omega);
}

/// Mean of exp(rate t) over the changes of the amplitude within a carrier period.
Complex mean_over_changes(Complex rate, int parts) {
  if (parts == 1) {
    return mean_of_exponential(rate);
  }
  // The first and the last change are half of the others.
  Complex sum = 0.5 * (1.0 + exponential(rate));
  for (int i = 1; i < parts; ++i) {
    sum += exponential(rate * (static_cast<double>(i) / parts));
  }
  return sum / static_cast<double>(parts);
}

}  // namespace

std::complex<double> rate_of(const Resonator& resonator) {
  const double decay = 0.5 * resonator.damping;
  return {-decay, numeric::sqrt(resonator.stiffness - decay * decay)};
}

std::complex<double> mean_of_exponential(std::complex<double> rate) {
  constexpr double few = 1e-5;
  return std::abs(rate) < few ? 1.0 + 0.5 * rate : (exponential(rate) - 1.0) / rate;
}

double ramp_kick(const Resonator& resonator, int parts) {
  const Complex rate = rate_of(resonator);
  // The free motion that takes a displacement with its velocity away.
  const auto kick = [&](Complex displacement, Complex velocity) {
    return -(velocity +
             j * (resonator.stiffness * displacement - rate.real() * velocity) / rate.imag());
  };
  const Complex displacement = 0.5 * forced_displacement(resonator);
  const Complex velocity = j * omega * displacement;
  // Those of a jump at t turn with the carrier: along e^{jωt} the one, the other against it.
  const Complex along = kick(displacement, velocity);
  const Complex against = kick(std::conj(displacement), std::conj(velocity));
  return std::abs(along * mean_over_changes(j * omega - rate, parts) +
                  against * mean_over_changes(-j * omega - rate, parts)) /
         std::abs(along + against);
}

ModeModel mode_model(const Resonator& resonator) {
  const Complex rate = rate_of(resonator);
  const double decay = -rate.real();
  const double rotation = rate.imag();
  const Complex displacement = forced_displacement(resonator);
  // The free motion begins where the steady one, changed, would have to be.
  const double x = displacement.real();
  const double v = -omega * displacement.imag();
  const Complex input_gain = -(v + j * (resonator.stiffness * x + decay * v) / rotation);
  const Complex along = mean_of_exponential(rate - j * omega);
  const Complex against = mean_of_exponential(std::conj(rate) - j * omega);
  const Complex period_rotation = exponential(rate);
  ModeModel model;
  model.rotation << period_rotation.real(), -period_rotation.imag(), period_rotation.imag(),
      period_rotation.real();
  model.input_gain = parts(input_gain);
  model.forced = parts(j * omega * displacement);
  model.output.col(0) = parts(along + against);
  model.output.col(1) = parts(j * (along - against));
  const double fading = mean_of_exponential(2.0 * rate.real()).real();
  const Complex beating = mean_of_exponential(2.0 * rate);
  model.square << fading + beating.real(), -beating.imag(), -beating.imag(),
      fading - beating.real();
  return model;
}

bool is_quick(const ModeModel& model) {
  constexpr double quick = 0.4;
  return (model.rotation - Eigen::Matrix2d::Identity()).col(0).norm() >= quick;
}

ObserverGains observer_gains(const ModeModel& model, double process, double noise) {
  using Matrix = Eigen::Matrix4d;
  Matrix dynamics = Matrix::Identity();
  dynamics.topLeftCorner<2, 2>() = model.rotation;
  Eigen::Matrix<double, 2, 4> sample;
  sample << model.output, Eigen::Matrix2d::Identity();
  const Matrix information = sample.transpose() * sample / noise;
  const Matrix before =
      riccati<Matrix>(dynamics.transpose(), information, process * Matrix::Identity());
  const Eigen::Matrix2d innovation_covariance =
      sample * before * sample.transpose() + noise * Eigen::Matrix2d::Identity();
  const Eigen::Matrix<double, 4, 2> gains =
      before * sample.transpose() * innovation_covariance.inverse();
  return {gains.topRows<2>(), gains.bottomRows<2>()};
}

Eigen::Matrix3d vibration_error(const ModeModel& model) {
  Eigen::Matrix3d error;
  error.topLeftCorner<2, 2>() =
      is_quick(model) ? model.square : Eigen::Matrix2d(model.output.transpose() * model.output);
  error.topRightCorner<2, 1>() = model.output.transpose() * model.forced;
  error.bottomLeftCorner<1, 2>() = error.topRightCorner<2, 1>().transpose();
  error(2, 2) = model.forced.squaredNorm();
  return error;
}

Eigen::RowVector3d feedback_gains(const ModeModel& model, const Eigen::Matrix3d& error,
                                  double stability) {
  using Matrix = Eigen::Matrix3d;
  Matrix dynamics = Matrix::Identity();
  dynamics.topLeftCorner<2, 2>() = model.rotation;
  dynamics *= stability;
  Eigen::Vector3d change;
  change << model.input_gain, 1.0;
  change *= stability;
  const double price = model.forced.squaredNorm();
  const Matrix cost = riccati<Matrix>(dynamics, change * change.transpose() / price, error);
  return change.transpose() * cost * dynamics / (price + change.dot(cost * change));
}

}  // namespace sonoglide::configure
