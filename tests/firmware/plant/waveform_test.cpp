/// Drives of straight pieces against closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::waveform_test {
namespace {

template <template <class> class Law>
using Plant = Model<Law<double>, Damped<double>, StraightDrive>;

/// From a phase, for a duration, by a force: a piece of a waveform.
using Piece = Interval<double, StraightForce<double>>;

constexpr Piece square[] = {{0.0, pi, {1.0, 0.0}}, {0.0, pi, {-1.0, 0.0}}};
constexpr Piece triangle[] = {{-0.5 * pi, pi, {0.0, -2.0 / pi}}, {-0.5 * pi, pi, {0.0, 2.0 / pi}}};
constexpr Piece sawtooth[] = {{-pi, 2.0 * pi, {0.0, -1.0 / pi}}};

/// Mean Coulomb friction over a period of a free mass whose vibration has no mean velocity.
template <class Solver, std::size_t Count>
double coulomb_ratio(const Piece (&pieces)[Count], double first_velocity, double sliding,
                     double setting) {
  auto solver = configured<Solver>(Case(), setting);
  State<double> state = {0.0, first_velocity, 0.0};
  MeanFriction<double> account;
  for (Piece piece : pieces) {
    piece.sliding_velocity = sliding;
    EXPECT_EQ(advance(solver, piece, state, account).error, Error::none);
  }
  EXPECT_NEAR(state.velocity, first_velocity, 1e-12);
  return account.friction_integral / (2.0 * pi);
}

using Taylor = EventTaylor<Plant<friction::Coulomb>, 12>;
using FixedSteps = Rk4<Plant<friction::Coulomb>>;

/// A square force makes a triangle of the velocity: rho = zeta.
TEST(Waveform, SquareForceOnAFreeMass) {
  for (const double ratio : {0.1, 0.5, 0.9}) {
    const double peak = 0.5 * pi;
    EXPECT_NEAR(coulomb_ratio<Taylor>(square, -peak, ratio * peak, 1e-12), ratio, 1e-12);
    EXPECT_NEAR(coulomb_ratio<FixedSteps>(square, -peak, ratio * peak, 1e-4), ratio, 1e-4);
  }
}

/// A triangle of force makes two parabolas of the velocity, peak pi/4: rho = 1 - sqrt(1 - zeta).
TEST(Waveform, TriangleForceOnAFreeMass) {
  for (const double ratio : {0.1, 0.5, 0.9}) {
    const double expected = 1.0 - std::sqrt(1.0 - ratio);
    const double sliding = ratio * 0.25 * pi;
    EXPECT_NEAR(coulomb_ratio<Taylor>(triangle, 0.0, sliding, 1e-12), expected, 1e-12);
    EXPECT_NEAR(coulomb_ratio<FixedSteps>(triangle, 0.0, sliding, 1e-4), expected, 1e-4);
  }
}

/// A sawtooth of force makes one parabola, v = t - t^2 / (2 pi) - pi / 3: V > 0 for
/// 2 pi sqrt(1 - 2 (pi / 3 - r) / pi) of the period.
TEST(Waveform, SawtoothForceOnAFreeMass) {
  for (const double sliding : {-0.3, 0.2, 0.8}) {
    const double expected = 2.0 * std::sqrt(1.0 / 3.0 + 2.0 * sliding / pi) - 1.0;
    EXPECT_NEAR(coulomb_ratio<Taylor>(sawtooth, -pi / 3.0, sliding, 1e-12), expected, 1e-12);
    EXPECT_NEAR(coulomb_ratio<FixedSteps>(sawtooth, -pi / 3.0, sliding, 1e-4), expected, 1e-4);
  }
}

/// On a spring, y = a (phase - phase0 cos(w t) - sin(w t) / w) / k from rest, and by the work of
/// the drive the same energy.
TEST(Waveform, RampOnASpring) {
  using Free = Plant<friction::None>;
  const double k = 0.4;
  const double w = std::sqrt(k);
  const double a = -0.7;
  const Free model = {{}, {0.0}, k};
  auto taylor = configured<EventTaylor<Free, 12>>(model, 1e-13);
  auto fixed = configured<Rk4<Free>>(model, 1e-2);
  const Piece interval = {-1.2, 3.0, {0.0, a}};
  const double expected = a / k * (1.8 + 1.2 * std::cos(3.0 * w) - std::sin(3.0 * w) / w);
  EXPECT_NEAR(advanced(fixed, interval, {}).displacement, expected, 1e-9);
  State<double> state;
  EnergyAccount<double> account;
  EXPECT_EQ(advance(taylor, interval, state, account).error, Error::none);
  EXPECT_NEAR(state.displacement, expected, 1e-12);
  EXPECT_NEAR(account.balance_residual(model, {}, state), 0.0, 1e-12);
}

}  // namespace
}  // namespace sonoglide::plant::waveform_test
