/// LuGre contact against closed forms, its limits and another solver.

#include "firmware/friction/lugre.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>

#include "firmware/friction/dahl_friction_ratio.hpp"
#include "random.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::lugre_test {
namespace {

using Law = friction::LuGre<double>;
using PlantModel = Model<Law, Damped<double>, CosineDrive>;
using Taylor = EventTaylor<PlantModel, 16>;
using FixedSteps = Rk4<PlantModel>;

PlantModel model_of(const Law& law, double friction_force = 0.0, double stiffness = 0.0,
                    double sign = 1.0) {
  return {{law, friction_force, sign}, {0.0}, stiffness};
}

/// A contact with what LuGre adds to the Dahl law, each number by its name.
struct Contact : Law {
  explicit Contact(double stiffness) { contact_stiffness = stiffness; }
  Contact& falling_from(double friction_at_rest, double within_velocity) {
    static_friction = friction_at_rest;
    stribeck_velocity = within_velocity;
    return *this;
  }
  Contact& damped(double damping) {
    bristle_damping = damping;
    return *this;
  }
  Contact& viscous(double friction_per_velocity) {
    viscous_friction = friction_per_velocity;
    return *this;
  }
};

/// It has everything, of a size that shows.
const Law complete = Contact(2.5).falling_from(1.5, 0.2).damped(0.1).viscous(0.06);

/// psi and phi at constant speed, from psi = 0.
void expect_relaxation(const RememberingState<Law>& state, const Law& law, double velocity,
                       double duration, double tolerance) {
  const double part = velocity / law.stribeck_velocity;
  const double curve = 1.0 + (law.static_friction - 1.0) * std::exp(-part * part);
  const double speed = std::abs(velocity);
  const double bristles = std::copysign(
      curve * -std::expm1(-law.contact_stiffness * speed * duration / curve), velocity);
  EXPECT_NEAR(state.memory, bristles, tolerance);
  EXPECT_NEAR(state.friction,
              bristles + law.bristle_damping * (velocity - speed * bristles / curve) +
                  law.viscous_friction * velocity,
              tolerance);
}

TEST(LuGre, RelaxesToItsStribeckCurveAtConstantSpeed) {
  for (const double velocity : {0.02, -0.02, 0.4, -3.0}) {
    const Law law = Contact(1.7).falling_from(1.8, 0.3).damped(0.05).viscous(0.02);
    auto taylor = configured<Taylor>(model_of(law), 1e-13);
    auto fixed = configured<FixedSteps>(model_of(law), 1e-3);
    for (const double duration : {0.7, 40.0}) {
      const Interval<double> interval = lasting(duration).sliding(velocity);
      expect_relaxation(advanced(taylor, interval, {}), law, velocity, duration, 2e-13);
      expect_relaxation(advanced(fixed, interval, {}), law, velocity, duration, 1e-11);
    }
  }
}

/// Mean friction under prescribed sinusoidal motion, once it is periodic.
template <class Solver = Taylor>
double prescribed_ratio(const Law& law, double velocity_ratio, double setting = 1e-14,
                        int settling_periods = 60) {
  auto solver = configured<Solver>(model_of(law), setting);
  RememberingState<Law> state = {{-1.0, 0.0, 0.0}, 0.0};
  MeanFriction<double> settling;
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, settling_periods, 1.0, velocity_ratio, state, settling),
            Error::none);
  EXPECT_EQ(run_periods(solver, 1, 1.0, velocity_ratio, state, account), Error::none);
  return account.friction_integral / (2.0 * pi);
}

TEST(LuGreLimits, Dahl) {
  EXPECT_NEAR(prescribed_ratio(Contact(0.404519756998724), 0.5), 0.674948666956629, 1e-12);
  EXPECT_NEAR(prescribed_ratio(Contact(2.023), 0.1), 0.08814, 1e-5);
  EXPECT_NEAR(prescribed_ratio(Contact(10.0), 0.5), friction::dahl_friction_ratio(0.5, 10.0),
              1e-12);
  EXPECT_NEAR((prescribed_ratio<FixedSteps>(Contact(0.404519756998724), 0.5, 1e-3)),
              0.674948666956629, 1e-6);
}

TEST(LuGreLimits, DahlInSinglePrecision) {
  using Single = Model<friction::LuGre<float>, Damped<float>, CosineDrive>;
  auto solver = configured<EventTaylor<Single, 8>>({{{0.40452F}, 0.0F, 1.0F}, {0.0F}, 0.0F}, 1e-7F);
  RememberingState<friction::LuGre<float>> state = {{-1.0F, 0.0F, 0.0F}, 0.0F};
  MeanFriction<float> settling;
  MeanFriction<float> account;
  EXPECT_EQ(run_periods(solver, 30, 1.0F, 0.5F, state, settling), Error::none);
  EXPECT_EQ(run_periods(solver, 1, 1.0F, 0.5F, state, account), Error::none);
  EXPECT_NEAR(static_cast<double>(account.friction_integral) / (2.0 * pi), 0.674948666956629, 1e-5);
}

TEST(LuGreLimits, Coulomb) {
  EXPECT_NEAR(prescribed_ratio(Contact(3e3), 0.5, 1e-8, 2), 1.0 / 3.0, 1e-3);
}

/// Whatever the bristles' damping, psi is periodic: the mean of its rate is nothing.
TEST(LuGre, PeriodicMeanIsThatOfDahlAndTheViscousShare) {
  for (const double velocity_ratio : {0.2, 0.5, 0.9}) {
    const Law law = Contact(1.5).damped(0.4).viscous(0.3);
    EXPECT_NEAR(prescribed_ratio(law, velocity_ratio),
                friction::dahl_friction_ratio(velocity_ratio, 1.5) + 0.3 * velocity_ratio, 1e-12);
  }
}

/// Stiff bristles follow the curve: phi = g(V) sgn V + eta V, averaged over the phase.
TEST(LuGre, StiffBristlesAverageTheStribeckCurve) {
  const Law law = Contact(3e3).falling_from(1.6, 0.4).viscous(0.1);
  constexpr int points = 200000;
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    const double velocity = 0.5 + std::cos(2.0 * pi * (i + 0.5) / points);
    const double curve = 1.0 + 0.6 * std::exp(-velocity * velocity / 0.16);
    sum += std::copysign(curve, velocity) + 0.1 * velocity;
  }
  EXPECT_NEAR(prescribed_ratio(law, 0.5, 1e-8, 2), sum / points, 2e-3);
}

/// A contact that does not slip is a spring and a damper: y'' = -k y - beta (kappa y + c y').
TEST(LuGre, SmallVibrationOfAStuckContact) {
  const Law law = Contact(40.0).falling_from(1.5, 0.1).damped(0.3).viscous(0.2);
  const double beta = 0.5;
  const double k = 0.3;
  const double decay = 0.5 * beta * (0.3 + 0.2);
  const double frequency = std::sqrt(k + beta * 40.0 - decay * decay);
  const double swing = 1e-9;
  const double duration = 9.7;
  auto solver = configured<Taylor>(model_of(law, beta, k), 1e-22);
  RememberingState<Law> state = {{swing, 0.0, 0.0}, 40.0 * swing};
  state = advanced(solver, lasting(duration), state);
  const double phase = frequency * duration;
  EXPECT_NEAR(state.displacement / swing,
              std::exp(-decay * duration) * (std::cos(phase) + decay / frequency * std::sin(phase)),
              1e-6);
}

using Peer = std::array<double, 3>;  // y, v, psi

/// The same plant by an integrator of the Boost library.
Peer peer_state(const PlantModel& model, const Interval<double>& interval, Peer x) {
  const auto slope = [&](const Peer& at, Peer& rate, double time) {
    const double sliding = interval.sliding_velocity + interval.sliding_acceleration * time;
    const double velocity = sliding + model.vibration_sign * at[1];
    const double part = velocity / model.law.stribeck_velocity;
    const double curve = 1.0 + (model.law.static_friction - 1.0) * std::exp(-part * part);
    const double bending = velocity - std::abs(velocity) * at[2] / curve;
    const double friction =
        at[2] + model.law.bristle_damping * bending + model.law.viscous_friction * velocity;
    rate = {at[1],
            interval.drive_amplitude * std::cos(interval.phase_begin + time) -
                model.stiffness * at[0] - model.friction_force * friction,
            model.law.contact_stiffness * bending};
  };
  namespace odeint = boost::numeric::odeint;
  odeint::integrate_adaptive(
      odeint::make_controlled<odeint::runge_kutta_dopri5<Peer>>(1e-13, 1e-13), slope, x, 0.0,
      interval.duration, 1e-4);
  return x;
}

TEST(LuGre, ReversingContactAgreesWithAPeer) {
  for (const double sign : {1.0, -1.0}) {
    const PlantModel model = model_of(complete, 0.3, 0.4, sign);
    const Interval<double> interval =
        lasting(9.0).from_phase(0.8).driven(1.0).sliding(0.4).accelerating(0.01);
    const Peer expected = peer_state(model, interval, {0.3, -0.2, 0.1});
    const auto expect_near = [&](const RememberingState<Law>& state, double tolerance) {
      EXPECT_NEAR(state.displacement, expected[0], tolerance);
      EXPECT_NEAR(state.velocity, expected[1], tolerance);
      EXPECT_NEAR(state.memory, expected[2], tolerance);
    };
    auto taylor = configured<Taylor>(model, 1e-13);
    auto fixed = configured<FixedSteps>(model, 1e-3);
    expect_near(advanced(taylor, interval, {{0.3, -0.2, 0.0}, 0.1}), 1e-10);
    expect_near(advanced(fixed, interval, {{0.3, -0.2, 0.0}, 0.1}), 2e-6);
    EXPECT_GE(taylor.cost().events, 2U);
    EXPECT_LE(taylor.cost().events, 8U);
  }
}

template <std::size_t Order>
double mean_friction(double tolerance) {
  auto solver = configured<EventTaylor<PlantModel, Order>>(model_of(complete, 0.3, 0.4), tolerance);
  RememberingState<Law> state;
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, 4, 1.0, 0.4, state, account), Error::none);
  return account.friction_integral / (8.0 * pi);
}

TEST(LuGre, ToleranceIsThatOfTheMeanFriction) {
  const double ratio = mean_friction<16>(1e-13);
  EXPECT_NEAR(mean_friction<8>(1e-4), ratio, 1e-4);
  EXPECT_NEAR(mean_friction<8>(1e-6), ratio, 1e-6);
  EXPECT_NEAR(mean_friction<16>(1e-10), ratio, 1e-10);
}

TEST(LuGre, MirroredMotionIsTheMirrorImageBitForBit) {
  auto solver = configured<Taylor>(model_of(complete, 0.3, 0.4), 1e-12);
  const auto one =
      advanced(solver, lasting(9.0).from_phase(0.3).driven(1.0).sliding(0.4).accelerating(0.01),
               {{0.3, -0.2, 0.0}, 0.1});
  const auto other =
      advanced(solver, lasting(9.0).from_phase(0.3).driven(-1.0).sliding(-0.4).accelerating(-0.01),
               {{-0.3, 0.2, 0.0}, -0.1});
  EXPECT_EQ(one.displacement, -other.displacement);
  EXPECT_EQ(one.velocity, -other.velocity);
  EXPECT_EQ(one.memory, -other.memory);
}

/// Explicit steps that are too long for the bristles are reported.
TEST(LuGre, StepsTooLongForTheBristlesAreReported) {
  auto solver = configured<FixedSteps>(
      model_of(Contact(1e4).falling_from(1.5, 0.2).damped(0.1).viscous(0.06)), 0.01);
  RememberingState<Law> state;
  NoAccount account;
  EXPECT_EQ(run_periods(solver, 1, 1.0, 0.5, state, account), Error::friction_bound_broken);
}

RC_GTEST_PROP(LuGreProperties, BalancesItsEnergyAndIsPassive, ()) {
  Law law = Contact(between(0.1, 50.0)).falling_from(between(1.0, 2.5), between(0.05, 2.0));
  law.bristle_damping = between(0.0, 0.5);
  law.viscous_friction = law.bristle_damping * (law.static_friction - 1.0) * between(1.0, 2.0);
  const PlantModel model = model_of(law, between(0.0, 0.5), between(0.0, 2.0));
  const RememberingState<Law> before = {{between(-1.0, 1.0), between(-1.0, 1.0), 0.0},
                                        between(-1.0, 1.0)};
  auto solver = configured<Taylor>(model, 1e-12);
  RememberingState<Law> state = before;
  EnergyAccount<double> account;
  RC_ASSERT(run_periods(solver, 2, between(0.0, 2.0), between(-2.0, 2.0), state, account) ==
            Error::none);
  RC_ASSERT(std::abs(account.balance_residual(model, before, state)) < 1e-9);
  RC_ASSERT(std::abs(state.memory) <= law.static_friction);
  const double stored =
      (state.memory * state.memory - before.memory * before.memory) / (2.0 * law.contact_stiffness);
  RC_ASSERT(account.friction_work >= stored - 1e-9);
}

/// What a step shows joins the next one.
struct Joints {
  double last_friction = 0.0;
  double worst_jump = 0.0;

  template <class Step>
  void operator()(const Step& step) {
    if (step.begin() > 0.0) {
      worst_jump = std::fmax(worst_jump, std::abs(step.at(0.0).friction - last_friction));
    }
    last_friction = step.at(step.length()).friction;
  }
};

template <class Solver>
double worst_jump(double setting) {
  auto solver = configured<Solver>(model_of(complete, 0.3, 0.4), setting);
  RememberingState<Law> state;
  NoAccount account;
  Joints joints;
  EXPECT_EQ(
      solver.advance(lasting(2.0 * pi).driven(1.0).sliding(0.4), state, account, joints).error,
      Error::none);
  EXPECT_NEAR(joints.last_friction, state.friction, 1e-12);
  return joints.worst_jump;
}

TEST(LuGre, FrictionOfTheStepsJoins) {
  EXPECT_LT(worst_jump<Taylor>(1e-13), 1e-11);
  EXPECT_LT(worst_jump<FixedSteps>(1e-2), 1e-11);
}

}  // namespace
}  // namespace sonoglide::plant::lugre_test
