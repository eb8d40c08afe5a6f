/// A load, a body of its own mass that slides: closed forms, balances and another integrator.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <type_traits>

#include "firmware/friction/coulomb.hpp"
#include "firmware/friction/dahl.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/iwan.hpp"
#include "firmware/friction/lugre.hpp"
#include "firmware/friction/none.hpp"
#include "firmware/friction/stribeck.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/rk4/rk4.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/taylor/event_taylor.hpp"
#include "random.hpp"

namespace sonoglide::plant::load_test {
namespace {

constexpr double turn = 6.283185307179586476925286766559;

template <class Law>
using Loaded = LoadedModel<Law, Damped<double>, CosineDrive>;

/// Every number of a plant with a load but those of its law.
struct Numbers {
  double friction_force = 0.0;
  double damping = 0.0;
  double stiffness = 0.0;
  double mass_ratio = 1.0;
  double load_damping = 0.0;
  double load_stiffness = 0.0;
};

template <class Law>
Loaded<Law> model_of(const Law& law, const Numbers& numbers) {
  Loaded<Law> model;
  if constexpr (!std::is_same_v<Law, friction::None<double>>) {
    model.law = law;
    model.friction_force = numbers.friction_force;
  }
  model.damping = numbers.damping;
  model.stiffness = numbers.stiffness;
  model.mass_ratio = numbers.mass_ratio;
  model.load_damping = numbers.load_damping;
  model.load_stiffness = numbers.load_stiffness;
  return model;
}

/// What acts over an interval.
struct Acting {
  double drive = 0.0;
  double force = 0.0;
  double force_rate = 0.0;
  double pull = 0.0;
  double pull_rate = 0.0;
};

using Span = LoadedInterval<double>;

Span lasting(double duration, const Acting& acting = {}) {
  Span span;
  span.duration = duration;
  span.drive_amplitude = acting.drive;
  span.sliding_velocity = acting.pull;
  span.sliding_acceleration = acting.pull_rate;
  span.load_force = acting.force;
  span.load_force_rate = acting.force_rate;
  return span;
}

template <class Solver, class State, class Account>
void advance(Solver& solver, const Span& span, State& state, Account& account) {
  NoObserver nobody;
  ASSERT_EQ(solver.advance(span, state, account, nobody).error, Error::none);
}
template <class Solver, class State>
void advance(Solver& solver, const Span& span, State& state) {
  NoAccount account;
  advance(solver, span, state, account);
}

template <class Law>
EventTaylor<Loaded<Law>, 16> taylor(const Loaded<Law>& model, double tolerance = 1e-13) {
  EventTaylor<Loaded<Law>, 16> solver;
  solver.configure(model, tolerance);
  return solver;
}

/// A free body on a spring whose end is pulled at one velocity, with a force that rises:
/// r'' = -kl (r - vp) - dl r' + f'.
TEST(Load, MovesFreelyWithoutFriction) {
  const friction::None<double> law;
  Numbers numbers;
  numbers.mass_ratio = 0.3;
  numbers.load_damping = 0.12;
  numbers.load_stiffness = 0.7;
  const double duration = 11.0;
  Acting acting;
  acting.force = 0.4;
  acting.force_rate = -0.03;
  acting.pull = 0.25;
  const double start = 0.8;
  // r = steady + e^(-a t) (p cos wt + q sin wt)
  const double a = 0.5 * numbers.load_damping;
  const double w = std::sqrt(numbers.load_stiffness - a * a);
  const double steady = acting.pull + acting.force_rate / numbers.load_stiffness;
  const double acceleration = acting.force - numbers.load_damping * start;
  const double p = start - steady;
  const double q = (acceleration + a * p) / w;
  const double velocity =
      steady + std::exp(-a * duration) * (p * std::cos(w * duration) + q * std::sin(w * duration));
  auto solver = taylor(model_of(law, numbers), 1e-14);
  LoadedState<double> state;
  state.sliding_velocity = start;
  advance(solver, lasting(duration, acting), state);
  EXPECT_NEAR(state.sliding_velocity, velocity, 1e-13);

  Rk4<Loaded<friction::None<double>>> fixed;
  fixed.configure(model_of(law, numbers), 1e-3);
  LoadedState<double> other;
  other.sliding_velocity = start;
  advance(fixed, lasting(duration, acting), other);
  EXPECT_NEAR(other.sliding_velocity, velocity, 1e-12);
  EXPECT_NEAR(other.extension, state.extension, 1e-12);
}

/// Under Coulomb friction on a mass that hardly moves, r falls by eps beta a unit of time and stops for good.
TEST(Load, StopsForGoodUnderCoulombFriction) {
  Numbers numbers;
  numbers.friction_force = 1e-3;
  numbers.stiffness = 100.0;
  numbers.damping = 20.0;  // aperiodic: no ringing after the stop
  numbers.mass_ratio = 0.01;
  auto solver = taylor(model_of(friction::Coulomb<double>(), numbers));
  const double start = 1e-3;
  const double deceleration = numbers.mass_ratio * numbers.friction_force;
  LoadedState<double> state;
  state.sliding_velocity = start;
  const double stop = start / deceleration;
  advance(solver, lasting(0.9 * stop), state);
  EXPECT_NEAR(state.sliding_velocity, 0.1 * start, 1e-15);
  EXPECT_EQ(state.friction, 1.0);
  EXPECT_EQ(solver.cost().events, 0U);
  advance(solver, lasting(0.2 * stop), state);
  // One more slip at most, as the mass that was pushed aside springs back.
  EXPECT_LE(solver.cost().events, 30U);
  EXPECT_EQ(state.sliding_velocity, -state.velocity);
  EXPECT_LT(std::abs(state.friction), 1.0);
  const double displacement = state.extension;
  LoadedEnergyAccount<double> account;
  advance(solver, lasting(20.0 * stop), state, account);
  EXPECT_EQ(account.friction_work, 0.0);  // it never slides again
  EXPECT_EQ(state.sliding_velocity, -state.velocity);
  EXPECT_NEAR(state.extension, displacement, 1e-4 * start * stop);
}

/// Two bodies that stick move as one: (1 + eps) r' = -eps k z' ..., here a free fall of both under a force.
TEST(Load, StuckBodiesMoveAsOne) {
  Numbers numbers;
  numbers.friction_force = 0.5;
  numbers.mass_ratio = 0.25;
  auto solver = taylor(model_of(friction::Coulomb<double>(), numbers));
  Acting acting;
  acting.force = 0.1;
  LoadedState<double> state;
  state.sliding_velocity = 0.2;
  state.velocity = -0.2;
  const double duration = 3.0;
  advance(solver, lasting(duration, acting), state);
  // M r' = Fa - F and m y'' = -F with r' = -y'': r' = fa/(1 + eps).
  const double acceleration = acting.force / (1.0 + numbers.mass_ratio);
  EXPECT_NEAR(state.sliding_velocity, 0.2 + acceleration * duration, 1e-14);
  EXPECT_NEAR(state.friction, acceleration / numbers.friction_force, 1e-14);
}

/// Without springs, dampers and outer forces the momentum of both stays.
RC_GTEST_PROP(LoadProperties, KeepsTheMomentum, ()) {
  Numbers numbers;
  numbers.friction_force = between(0.01, 0.5);
  numbers.mass_ratio = std::pow(10.0, between(-3.0, 2.0));
  friction::LuGre<double> law;
  law.contact_stiffness = between(0.5, 20.0);
  law.static_friction = between(1.0, 1.8);
  law.stribeck_velocity = between(0.1, 1.0);
  law.bristle_damping = between(0.0, 0.2);
  law.viscous_friction = 0.3;
  auto solver = taylor(model_of(law, numbers));
  RememberingState<friction::LuGre<double>, LoadedState<double>> state;
  state.velocity = between(-1.0, 1.0);
  state.sliding_velocity = between(-1.0, 1.0);
  const double before = state.sliding_velocity / numbers.mass_ratio - state.velocity;
  advance(solver, lasting(2.0 * turn), state);
  const double after = state.sliding_velocity / numbers.mass_ratio - state.velocity;
  RC_ASSERT(std::abs(after - before) < 1e-11 * (1.0 + 1.0 / numbers.mass_ratio));
}

// ---- Another integrator ----

using Peer = std::array<double, 5>;  // y, v, memory, r, z

/// Friction and the derivative of what the contact remembers, at a sliding velocity.
struct Rub {
  double friction;
  double memory_rate;
};
Rub rub(const friction::Dahl<double>& law, double velocity, double memory) {
  return {memory, law.contact_stiffness * (velocity - std::abs(velocity) * memory)};
}
Rub rub(const friction::LuGre<double>& law, double velocity, double memory) {
  const double part = velocity / law.stribeck_velocity;
  const double curve = 1.0 + (law.static_friction - 1.0) * std::exp(-part * part);
  const double bending = velocity - std::abs(velocity) * memory / curve;
  return {memory + law.bristle_damping * bending + law.viscous_friction * velocity,
          law.contact_stiffness * bending};
}
/// While it slides forwards.
Rub rub(const friction::Stribeck<double>& law, double velocity, double /*memory*/) {
  return {1.0 - law.fall * velocity + law.rise * velocity * velocity * velocity, 0.0};
}

/// The equations of LoadedModel as its docstring has them.
template <class Law>
Peer peer_state(const Loaded<Law>& model, const Span& span, Peer x) {
  const auto slope = [&](const Peer& at, Peer& rate, double time) {
    const Rub contact = rub(model.law, at[3] + at[1], at[2]);
    const double force = model.friction_force * contact.friction;
    rate = {at[1],
            span.drive_amplitude * std::cos(span.phase_begin + time) - model.damping * at[1] -
                model.stiffness * at[0] - force,
            contact.memory_rate,
            span.load_force + span.load_force_rate * time - model.load_damping * at[3] -
                model.load_stiffness * at[4] - model.mass_ratio * force,
            at[3] - span.sliding_velocity - span.sliding_acceleration * time};
  };
  namespace odeint = boost::numeric::odeint;
  odeint::integrate_adaptive(
      odeint::make_controlled<odeint::runge_kutta_dopri5<Peer>>(1e-15, 1e-15), slope, x, 0.0,
      span.duration, 1e-4);
  return x;
}

Numbers random_numbers() {
  Numbers numbers;
  numbers.friction_force = between(0.01, 0.5);
  numbers.damping = between(0.0, 0.3);
  numbers.stiffness = between(0.0, 2.0);
  numbers.mass_ratio = std::pow(10.0, between(-2.0, 1.0));
  numbers.load_damping = between(0.0, 0.3);
  numbers.load_stiffness = between(0.0, 0.5);
  return numbers;
}

Acting random_acting() {
  Acting acting;
  acting.drive = between(0.0, 1.5);
  acting.force = between(-0.2, 0.2);
  acting.force_rate = between(-0.02, 0.02);
  acting.pull = between(-0.5, 0.5);
  acting.pull_rate = between(-0.02, 0.02);
  return acting;
}

template <class State>
void expect_near(const State& state, const Peer& expected, double tolerance) {
  RC_ASSERT(std::abs(state.displacement - expected[0]) < tolerance);
  RC_ASSERT(std::abs(state.velocity - expected[1]) < tolerance);
  RC_ASSERT(std::abs(contact_memory(state) - expected[2]) < tolerance);
  RC_ASSERT(std::abs(state.sliding_velocity - expected[3]) < tolerance);
  RC_ASSERT(std::abs(state.extension - expected[4]) < tolerance);
}

/// Both solvers against the peer, and both balances.
template <class Law, class State>
void expect_peer(const Law& law) {
  const Loaded<Law> model = model_of(law, random_numbers());
  const Span span = lasting(9.0, random_acting());
  State before;
  before.displacement = between(-1.0, 1.0);
  before.velocity = between(-1.0, 1.0);
  contact_memory(before) = between(-1.0, 1.0);
  before.sliding_velocity = between(-1.0, 1.0);
  const Peer expected = peer_state(model, span,
                                   {before.displacement, before.velocity, contact_memory(before),
                                    before.sliding_velocity, before.extension});
  auto solver = taylor(model);
  State state = before;
  LoadedEnergyAccount<double> account;
  advance(solver, span, state, account);
  expect_near(state, expected, 1e-9);
  RC_ASSERT(std::abs(account.balance_residual(model, before, state)) < 1e-10);
  RC_ASSERT(std::abs(account.load_residual(model, before, state)) < 1e-10);

  Rk4<Loaded<Law>> fixed;
  fixed.configure(model, 1e-3);
  State other = before;
  LoadedEnergyAccount<double> sums;
  advance(fixed, span, other, sums);
  expect_near(other, expected, 1e-4);
  RC_ASSERT(std::abs(sums.load_residual(model, before, other)) < 1e-5);
}

RC_GTEST_PROP(LoadProperties, DahlAgreesWithAPeer, ()) {
  friction::Dahl<double> law;
  law.contact_stiffness = between(0.2, 10.0);
  expect_peer<friction::Dahl<double>, LoadedState<double>>(law);
}

RC_GTEST_PROP(LoadProperties, LuGreAgreesWithAPeer, ()) {
  using Law = friction::LuGre<double>;
  Law law;
  law.contact_stiffness = between(0.2, 10.0);
  law.static_friction = between(1.0, 1.8);
  law.stribeck_velocity = between(0.2, 1.0);
  law.bristle_damping = between(0.0, 0.2);
  law.viscous_friction = law.bristle_damping * (law.static_friction - 1.0) * between(1.0, 2.0);
  expect_peer<Law, RememberingState<Law, LoadedState<double>>>(law);
}

/// Where nothing reverses.
RC_GTEST_PROP(LoadProperties, SlidingStribeckContactAgreesWithAPeer, ()) {
  using Law = friction::Stribeck<double>;
  Law law;
  law.fall = between(0.0, 0.3);
  law.rise = between(0.05, 0.1);
  Numbers numbers = random_numbers();
  numbers.mass_ratio = between(0.01, 0.1);
  const Loaded<Law> model = model_of(law, numbers);
  Acting acting = random_acting();
  acting.drive *= 0.2;
  const Span span = lasting(4.0, acting);
  LoadedState<double> state;
  state.sliding_velocity = between(2.5, 3.5);
  const Peer expected = peer_state(model, span, {0.0, 0.0, 0.0, state.sliding_velocity, 0.0});
  auto solver = taylor(model);
  advance(solver, span, state);
  RC_PRE(solver.cost().events == 0U);
  RC_ASSERT(std::abs(state.displacement - expected[0]) < 1e-9);
  RC_ASSERT(std::abs(state.sliding_velocity - expected[3]) < 1e-9);
  RC_ASSERT(std::abs(state.extension - expected[4]) < 1e-9);
}

/// Laws that stick or have corners: both solvers' balances, and an advance in parts.
template <class Law, class State>
void expect_balance(const Law& law) {
  const Loaded<Law> model = model_of(law, random_numbers());
  State before;
  before.displacement = between(-1.0, 1.0);
  before.velocity = between(-1.0, 1.0);
  before.sliding_velocity = between(-1.0, 1.0);
  Acting acting = random_acting();
  acting.force_rate = 0.0;
  acting.pull_rate = 0.0;
  auto solver = taylor(model);
  State state = before;
  LoadedEnergyAccount<double> account;
  advance(solver, lasting(3.0 * turn, acting), state, account);
  RC_ASSERT(std::abs(account.balance_residual(model, before, state)) < 1e-10);
  RC_ASSERT(std::abs(account.load_residual(model, before, state)) < 1e-10);
  RC_ASSERT(account.friction_work >= -1e-9);

  State other = before;
  for (int i = 0; i < 3; ++i) {
    advance(solver, lasting(turn, acting), other);
  }
  RC_ASSERT(std::abs(other.sliding_velocity - state.sliding_velocity) < 1e-9);
  RC_ASSERT(std::abs(other.displacement - state.displacement) < 1e-9);
}

RC_GTEST_PROP(LoadProperties, CoulombBalancesTheEnergyOfBothBodies, ()) {
  expect_balance<friction::Coulomb<double>, LoadedState<double>>({});
}

RC_GTEST_PROP(LoadProperties, StribeckBalancesTheEnergyOfBothBodies, ()) {
  friction::Stribeck<double> law;
  law.fall = between(0.0, 0.5);
  law.rise = between(0.1, 0.3);
  expect_balance<friction::Stribeck<double>, LoadedState<double>>(law);
}

/// Half a carrier period is cut out of a run with a heavy load: its velocity falls by eps beta times the
/// friction ratio of the closed form.
TEST(Load, HeavyBodyIsBrakedByTheFrictionRatio) {
  const double dahl_number = 0.8;
  Numbers numbers;
  numbers.friction_force = 1e-7;  // hardly felt by the vibration
  numbers.mass_ratio = 1e-3;
  friction::Dahl<double> law;
  law.contact_stiffness = dahl_number;  // the vibration has unit amplitude
  auto solver = taylor(model_of(law, numbers));
  for (const double ratio : {0.2, 0.5, 0.9}) {
    LoadedState<double> state;
    state.displacement = -1.0;  // of a free mass under cos: y = -cos
    state.sliding_velocity = ratio;
    Acting acting;
    acting.drive = 1.0;
    for (int i = 0; i < 40; ++i) {  // until the contact has forgotten its beginning
      advance(solver, lasting(turn, acting), state);
    }
    const double before = state.sliding_velocity;
    const int periods = 200;
    for (int i = 0; i < periods; ++i) {
      advance(solver, lasting(turn, acting), state);
    }
    const double fall = (before - state.sliding_velocity) / (periods * turn);
    const double expected = numbers.mass_ratio * numbers.friction_force *
                            friction::dahl_friction_ratio(ratio, dahl_number);
    EXPECT_NEAR(fall / expected, 1.0, 1e-3) << ratio;
  }
}

/// Of the mean velocity of the body in a carrier period, once it has settled, over that of the pull.
struct Extremes {
  double slowest = 1e9;
  double fastest = -1e9;
};

/// A body that is pulled slowly by a spring, over friction that falls with the velocity.
Extremes pulled_slowly(double drive) {
  friction::Stribeck<double> law;
  law.fall = 0.8;
  law.rise = 0.2;
  Numbers numbers;
  numbers.friction_force = 0.05;
  numbers.stiffness = 50.0;
  numbers.damping = 1.0;
  numbers.mass_ratio = 0.1;
  numbers.load_stiffness = 1e-3;
  auto solver = taylor(model_of(law, numbers), 1e-10);
  Acting acting;
  acting.drive = drive;
  acting.pull = 0.01;
  LoadedState<double> state;
  Extremes seen;
  for (int i = 0; i < 1000; ++i) {
    const double before = state.extension;
    advance(solver, lasting(turn, acting), state);
    const double mean = 1.0 + (state.extension - before) / (turn * acting.pull);
    if (i > 700) {
      seen.slowest = std::fmin(seen.slowest, mean);
      seen.fastest = std::fmax(seen.fastest, mean);
    }
  }
  return seen;
}

TEST(Load, SticksAndSlipsOnItsSpringUnlessItIsDriven) {
  const Extremes undriven = pulled_slowly(0.0);
  EXPECT_LT(undriven.slowest, 0.1);
  EXPECT_GT(undriven.fastest, 1.8);
  // A vibration velocity of 0.05: the mean friction rises, (2/pi)/sqrt(0.05^2 - 0.01^2) > 0.8.
  const Extremes driven = pulled_slowly(0.05 * 49.0);
  EXPECT_GT(driven.slowest, 0.9);
  EXPECT_LT(driven.fastest, 1.1);
}

TEST(Load, SolversOfferWhatASolverDoes) {
  static_assert(check_solver<EventTaylor<Loaded<friction::Iwan<double>>, 12>>());
  static_assert(check_solver<Rk4<Loaded<friction::Coulomb<double>>>>());
}

}  // namespace
}  // namespace sonoglide::plant::load_test
