/// LuGre contact against closed forms, its limits and another solver.

#include "firmware/friction/lugre.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "contact_peer.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "law_runs.hpp"

namespace sonoglide::plant::lugre_test {
namespace {

using Law = friction::LuGre<double>;
using PlantModel = LawModel<Law>;

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
const Case felt = Case().friction_force(0.3).stiffness(0.4);

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
    auto exact = taylor(law, 1e-13);
    auto fixed = fixed_steps(law, 1e-3);
    for (const double duration : {0.7, 40.0}) {
      const Interval<double> interval = lasting(duration).sliding(velocity);
      expect_relaxation(advanced(exact, interval, {}), law, velocity, duration, 2e-13);
      expect_relaxation(advanced(fixed, interval, {}), law, velocity, duration, 1e-11);
    }
  }
}

double periodic_ratio(const Law& law, double velocity_ratio) {
  return prescribed_ratio(taylor(law, 1e-14), velocity_ratio, 60);
}

TEST(LuGreLimits, Dahl) {
  EXPECT_NEAR(periodic_ratio(Contact(0.404519756998724), 0.5), 0.674948666956629, 1e-12);
  EXPECT_NEAR(periodic_ratio(Contact(2.023), 0.1), 0.08814, 1e-5);
  EXPECT_NEAR(periodic_ratio(Contact(10.0), 0.5), friction::dahl_friction_ratio(0.5, 10.0), 1e-12);
  EXPECT_NEAR(prescribed_ratio(fixed_steps<Law>(Contact(0.404519756998724), 1e-3), 0.5, 60),
              0.674948666956629, 1e-6);
  EXPECT_NEAR(prescribed_ratio(taylor<8>(friction::LuGre<float>{0.40452F}, 1e-7), 0.5, 30),
              0.674948666956629, 1e-5);
}

TEST(LuGreLimits, Coulomb) {
  EXPECT_NEAR(prescribed_ratio(taylor<16, Law>(Contact(3e3), 1e-8), 0.5, 2), 1.0 / 3.0, 1e-3);
}

/// Whatever the bristles' damping, psi is periodic: the mean of its rate is nothing.
TEST(LuGre, PeriodicMeanIsThatOfDahlAndTheViscousShare) {
  for (const double velocity_ratio : {0.2, 0.5, 0.9}) {
    const Law law = Contact(1.5).damped(0.4).viscous(0.3);
    EXPECT_NEAR(periodic_ratio(law, velocity_ratio),
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
  EXPECT_NEAR(prescribed_ratio(taylor(law, 1e-8), 0.5, 2), sum / points, 2e-3);
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
  auto solver = taylor(law, 1e-22, Case().friction_force(beta).stiffness(k));
  RememberingState<Law> state = {{swing, 0.0, 0.0}, 40.0 * swing};
  state = advanced(solver, lasting(duration), state);
  const double phase = frequency * duration;
  EXPECT_NEAR(state.displacement / swing,
              std::exp(-decay * duration) * (std::cos(phase) + decay / frequency * std::sin(phase)),
              1e-6);
}

using Peer = std::array<double, 3>;  // y, v, psi

Peer peer_state(const PlantModel& model, const Interval<double>& interval, const Peer& before) {
  const auto slope = [&](const Peer& at, Peer& rate, double time) {
    const double sliding = interval.sliding_velocity + interval.sliding_acceleration * time;
    const Rub contact = rub(model.law, sliding + model.vibration_sign * at[1], at[2]);
    rate = {at[1],
            interval.drive_amplitude * std::cos(interval.phase_begin + time) -
                model.stiffness * at[0] - model.friction_force * contact.friction,
            contact.memory_rate};
  };
  return by_odeint(slope, before, interval.duration, 1e-13);
}

TEST(LuGre, ReversingContactAgreesWithAPeer) {
  for (const double sign : {1.0, -1.0}) {
    const PlantModel model = felt.vibration_sign(sign).of(complete);
    const Interval<double> interval =
        lasting(9.0).from_phase(0.8).driven(1.0).sliding(0.4).accelerating(0.01);
    const Peer expected = peer_state(model, interval, {0.3, -0.2, 0.1});
    const auto expect_near = [&](const RememberingState<Law>& state, double tolerance) {
      EXPECT_NEAR(state.displacement, expected[0], tolerance);
      EXPECT_NEAR(state.velocity, expected[1], tolerance);
      EXPECT_NEAR(state.memory, expected[2], tolerance);
    };
    auto exact = configured<EventTaylor<PlantModel, 16>>(model, 1e-13);
    auto fixed = configured<Rk4<PlantModel>>(model, 1e-3);
    expect_near(advanced(exact, interval, {{0.3, -0.2, 0.0}, 0.1}), 1e-10);
    expect_near(advanced(fixed, interval, {{0.3, -0.2, 0.0}, 0.1}), 2e-6);
    EXPECT_GE(exact.cost().events, 2U);
    EXPECT_LE(exact.cost().events, 8U);
  }
}

TEST(LuGre, ToleranceIsThatOfTheMeanFriction) {
  expect_tolerance_is_that_of_the_mean(complete);
}

TEST(LuGre, MirroredMotionIsTheMirrorImageBitForBit) {
  expect_mirror_image(complete, 0.1);
}

/// Explicit steps that are too long for the bristles are reported.
TEST(LuGre, StepsTooLongForTheBristlesAreReported) {
  auto solver =
      fixed_steps<Law>(Contact(1e4).falling_from(1.5, 0.2).damped(0.1).viscous(0.06), 0.01);
  RememberingState<Law> state;
  NoAccount account;
  EXPECT_EQ(run_periods(solver, 1, 1.0, 0.5, state, account), Error::friction_bound_broken);
}

RC_GTEST_PROP(LuGreProperties, BalancesItsEnergyAndIsPassive, ()) {
  Law law = Contact(between(0.1, 50.0)).falling_from(between(1.0, 2.5), between(0.05, 2.0));
  law.bristle_damping = between(0.0, 0.5);
  law.viscous_friction = law.bristle_damping * (law.static_friction - 1.0) * between(1.0, 2.0);
  const PlantModel model = random_case().of(law);
  RememberingState<Law> before = random_motion(law);
  before.memory = between(-1.0, 1.0);
  auto solver = configured<EventTaylor<PlantModel, 16>>(model, 1e-12);
  const auto [state, account] = balanced(solver, model, before, between(-2.0, 2.0));
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
double worst_jump(Solver solver) {
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
  EXPECT_LT(worst_jump(taylor(complete, 1e-13, felt)), 1e-11);
  EXPECT_LT(worst_jump(fixed_steps(complete, 1e-2, felt)), 1e-11);
}

}  // namespace
}  // namespace sonoglide::plant::lugre_test
