/// Vibration across the sliding: closed-form ratio, straight-line braking, energy, and a peer.

#include "firmware/friction/transverse_coulomb.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>

#include "firmware/friction/transverse_vibration_ratio.hpp"
#include "law_runs.hpp"

namespace sonoglide::plant::transverse_coulomb_test {
namespace {

using Law = friction::TransverseCoulomb<double>;
using PlantModel = LawModel<Law>;

TEST(TransverseCoulomb, MeanUnderPrescribedVibrationIsTheClosedForm) {
  for (const double ratio : {1e-3, 0.02, 0.1, 0.3, 0.5, 0.8, 1.0, 3.0, 40.0}) {
    const double expected = friction::transverse_vibration_ratio(ratio);
    EXPECT_NEAR(prescribed_ratio(taylor(Law(), 1e-13), ratio), expected, 1e-12) << ratio;
    EXPECT_NEAR(prescribed_ratio(taylor(Law(), 1e-13), -ratio), -expected, 1e-12) << ratio;
  }
  for (const double ratio : {0.1, 0.5, 1.0}) {
    EXPECT_NEAR(prescribed_ratio(fixed_steps(Law(), 2.0 * pi / 1000.0), ratio),
                friction::transverse_vibration_ratio(ratio), 1e-9)
        << ratio;
  }
}

TEST(TransverseCoulomb, MeanIsThePublishedOne) {
  EXPECT_NEAR(prescribed_ratio(taylor(Law(), 1e-10), 0.1), 0.23442, 5e-6);
  EXPECT_NEAR(prescribed_ratio(taylor(Law(), 1e-10), 0.5), 0.64264, 5e-6);
  EXPECT_NEAR(prescribed_ratio(taylor(Law(), 1e-10), 1.0), 0.83463, 5e-6);
}

/// Nothing hides a reversal here: the formula keeps its fourth order.
TEST(TransverseCoulomb, FixedStepsKeepTheirFourthOrder) {
  const Interval<double> interval =
      lasting(9.0).from_phase(0.3).driven(1.0).sliding(0.4).accelerating(0.01);
  const Case c = Case().friction_force(0.3).stiffness(0.4);
  auto exact = taylor(Law(), 1e-14, c);
  const double displacement = advanced(exact, interval, {0.3, -0.2, 0.0}).displacement;
  const auto error = [&](double step) {
    auto solver = fixed_steps(Law(), step, c);
    return std::abs(advanced(solver, interval, {0.3, -0.2, 0.0}).displacement - displacement);
  };
  EXPECT_NEAR(std::log2(error(9.0 / 1024.0) / error(9.0 / 2048.0)), 4.0, 0.3);
}

TEST(TransverseCoulomb, ToleranceIsThatOfTheMeanFriction) {
  for (const double ratio : {0.003, 0.1, 0.7}) {
    const double expected = friction::transverse_vibration_ratio(ratio);
    const auto mean = [&](const auto& solver) {
      return mean_friction(solver, {-1.0, 0.0, 0.0}, ratio, 4);
    };
    expect_tolerance_is_that_of_the_mean(Law(), Case(), mean, expected);
  }
}

TEST(TransverseCoulomb, MeanInSinglePrecision) {
  EXPECT_NEAR(prescribed_ratio(taylor<8>(friction::TransverseCoulomb<float>(), 1e-6), 0.1),
              friction::transverse_vibration_ratio(0.1), 1e-6);
}

/// A free mass that friction brakes, v' = -beta v / sqrt(r^2 + v^2): with v = r sinh(g) it is
/// beta tau / r = G(g0) - G(g), G = ln tanh(g / 2) + cosh g.
TEST(TransverseCoulomb, FreeMassIsBrakedAsInClosedForm) {
  const double r = 0.3;
  const double beta = 0.2;
  const auto potential = [&](double velocity) {
    const double g = std::asinh(velocity / r);
    return std::log(std::tanh(0.5 * g)) + std::cosh(g);
  };
  auto exact = taylor(Law(), 1e-14, Case().friction_force(beta));
  auto fixed = fixed_steps(Law(), 1e-3, Case().friction_force(beta));
  const Interval<double> interval = lasting(4.0).sliding(r);
  for (const State<double>& state :
       {advanced(exact, interval, {0.0, 1.0, 0.0}), advanced(fixed, interval, {0.0, 1.0, 0.0})}) {
    EXPECT_NEAR(potential(1.0) - potential(state.velocity), beta * 4.0 / r, 1e-11);
    EXPECT_NEAR(state.friction, r / std::hypot(r, state.velocity), 1e-15);
  }
}

/// The same plant by an integrator of the Boost library; the last is the integral of phi.
TEST(TransverseCoulomb, AgreesWithAPeer) {
  using Numbers = std::array<double, 3>;
  namespace odeint = boost::numeric::odeint;
  // r passes through 0 at 3.33.
  const Interval<double> interval =
      lasting(6.0).from_phase(0.8).driven(1.0).sliding(0.2).accelerating(-0.06);
  const auto slope = [&](const Numbers& at, Numbers& rate, double time) {
    const double sliding = interval.sliding_velocity + interval.sliding_acceleration * time;
    const double speed = std::hypot(sliding, at[1]);
    rate = {at[1], std::cos(0.8 + time) - 0.4 * at[0] - 0.05 * at[1] - 0.5 * at[1] / speed,
            sliding / speed};
  };
  Numbers expected = {0.3, -0.2, 0.0};
  odeint::integrate_adaptive(
      odeint::make_controlled(1e-14, 1e-14, odeint::runge_kutta_fehlberg78<Numbers>()), slope,
      expected, 0.0, 6.0, 1e-3);
  auto solver = taylor(Law(), 1e-14, Case().friction_force(0.5).damping(0.05).stiffness(0.4));
  State<double> state = {0.3, -0.2, 0.0};
  MeanFriction<double> account;
  EXPECT_EQ(advance(solver, interval, state, account).error, Error::none);
  EXPECT_NEAR(state.displacement, expected[0], 1e-11);
  EXPECT_NEAR(state.velocity, expected[1], 1e-11);
  EXPECT_NEAR(account.friction_integral, expected[2], 1e-11);
}

/// Every pull on the contact is the oscillator's own: no sliding velocity reverses the force on it.
TEST(TransverseCoulomb, OscillatorIsTheSameEitherWay) {
  expect_mirror_image(Law(), 0.0);
}

/// At rest where nothing slides there is no direction of friction: said, not guessed.
TEST(TransverseCoulomb, AtRestWithoutSlidingIsAnError) {
  auto solver = taylor(Law(), 1e-10, Case().friction_force(0.6));
  State<double> state;
  NoAccount account;
  EXPECT_EQ(advance(solver, lasting(1.0).driven(1.0), state, account).error, Error::not_finite);
}

template <class Solver>
void keeps_its_bound_and_balances_its_energy(double setting, double allowed) {
  const PlantModel model = random_case().of(Law());
  auto solver = configured<Solver>(model, setting);
  const auto [state, account] =
      balanced(solver, model, random_motion(Law()), between(0.05, 2.0), allowed);
  RC_ASSERT(std::abs(state.friction) <= 1.0);
  // What is taken, is taken from the pull and from the vibration.
  RC_ASSERT(account.sliding_work >= 0.0);
  RC_ASSERT(account.friction_work >= account.sliding_work);
}

RC_GTEST_PROP(TransverseCoulombProperties, KeepsItsBoundAndBalancesItsEnergy, ()) {
  keeps_its_bound_and_balances_its_energy<EventTaylor<PlantModel, 16>>(1e-12, 1e-9);
}

RC_GTEST_PROP(TransverseCoulombProperties, SoDoFixedSteps, ()) {
  keeps_its_bound_and_balances_its_energy<Rk4<PlantModel>>(1e-3, 1e-6);
}

}  // namespace
}  // namespace sonoglide::plant::transverse_coulomb_test
