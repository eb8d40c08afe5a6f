/// A load, a body of its own mass that slides: closed forms, balances and another integrator.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "contact_peer.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/iwan.hpp"
#include "random.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::load_test {
namespace {

constexpr double turn = 2.0 * pi;

template <class Law>
using Loaded = LoadedModel<Law, Damped<double>, CosineDrive>;

template <class Solver, class Account>
void advance_without_error(Solver& solver, const Course& course, StateFor<Solver>& state,
                           Account& account) {
  ASSERT_EQ(advance(solver, course, state, account).error, Error::none);
}
template <class Solver>
void advance_without_error(Solver& solver, const Course& course, StateFor<Solver>& state) {
  NoAccount account;
  advance_without_error(solver, course, state, account);
}

template <class Law>
EventTaylor<Loaded<Law>, 16> solver_of(const Loaded<Law>& model, double tolerance = 1e-13) {
  return configured<EventTaylor<Loaded<Law>, 16>>(model, tolerance);
}

/// A free body on a spring whose end is pulled at one velocity, with a force that rises:
/// r'' = -kl (r - vp) - dl r' + f'.
TEST(Load, MovesFreelyWithoutFriction) {
  const double damping = 0.12;
  const double stiffness = 0.7;
  const double duration = 11.0;
  const double force = 0.4;
  const double force_rate = -0.03;
  const double pull = 0.25;
  const double start = 0.8;
  const auto model = Case().mass_ratio(0.3).load_damping(damping).load_stiffness(stiffness).loaded(
      friction::None<double>());
  const Course course = lasting(duration).sliding(pull).pushed(force, force_rate);
  // r = steady + e^(-a t) (p cos wt + q sin wt)
  const double a = 0.5 * damping;
  const double w = std::sqrt(stiffness - a * a);
  const double steady = pull + force_rate / stiffness;
  const double acceleration = force - damping * start;
  const double p = start - steady;
  const double q = (acceleration + a * p) / w;
  const double velocity =
      steady + std::exp(-a * duration) * (p * std::cos(w * duration) + q * std::sin(w * duration));
  auto solver = solver_of(model, 1e-14);
  LoadedState<double> state;
  state.sliding_velocity = start;
  advance_without_error(solver, course, state);
  EXPECT_NEAR(state.sliding_velocity, velocity, 1e-13);

  auto fixed = configured<Rk4<Loaded<friction::None<double>>>>(model, 1e-3);
  LoadedState<double> other;
  other.sliding_velocity = start;
  advance_without_error(fixed, course, other);
  EXPECT_NEAR(other.sliding_velocity, velocity, 1e-12);
  EXPECT_NEAR(other.extension, state.extension, 1e-12);
}

/// Under Coulomb friction on a mass that hardly moves, r falls by eps beta a unit of time and stops for good.
TEST(Load, StopsForGoodUnderCoulombFriction) {
  // Damped aperiodically: no ringing after the stop.
  const Case c = Case().friction_force(1e-3).stiffness(100.0).damping(20.0).mass_ratio(0.01);
  auto solver = solver_of(c.loaded(friction::Coulomb<double>()));
  const double start = 1e-3;
  const double deceleration = 0.01 * 1e-3;
  LoadedState<double> state;
  state.sliding_velocity = start;
  const double stop = start / deceleration;
  advance_without_error(solver, lasting(0.9 * stop), state);
  EXPECT_NEAR(state.sliding_velocity, 0.1 * start, 1e-15);
  EXPECT_EQ(state.friction, 1.0);
  EXPECT_EQ(solver.cost().events, 0U);
  advance_without_error(solver, lasting(0.2 * stop), state);
  // One more slip at most, as the mass that was pushed aside springs back.
  EXPECT_LE(solver.cost().events, 30U);
  EXPECT_EQ(state.sliding_velocity, -state.velocity);
  EXPECT_LT(std::abs(state.friction), 1.0);
  const double displacement = state.extension;
  LoadedEnergyAccount<double> account;
  advance_without_error(solver, lasting(20.0 * stop), state, account);
  EXPECT_EQ(account.friction_work, 0.0);  // it never slides again
  EXPECT_EQ(state.sliding_velocity, -state.velocity);
  EXPECT_NEAR(state.extension, displacement, 1e-4 * start * stop);
}

/// Two bodies that stick move as one: (1 + eps) r' = -eps k z' ..., here a free fall of both under a force.
TEST(Load, StuckBodiesMoveAsOne) {
  const double friction_force = 0.5;
  const double mass_ratio = 0.25;
  const double force = 0.1;
  const Case c = Case().friction_force(friction_force).mass_ratio(mass_ratio);
  auto solver = solver_of(c.loaded(friction::Coulomb<double>()));
  LoadedState<double> state;
  state.sliding_velocity = 0.2;
  state.velocity = -0.2;
  const double duration = 3.0;
  advance_without_error(solver, lasting(duration).pushed(force), state);
  // M r' = Fa - F and m y'' = -F with r' = -y'': r' = fa/(1 + eps).
  const double acceleration = force / (1.0 + mass_ratio);
  EXPECT_NEAR(state.sliding_velocity, 0.2 + acceleration * duration, 1e-14);
  EXPECT_NEAR(state.friction, acceleration / friction_force, 1e-14);
}

/// Without springs, dampers and outer forces the momentum of both stays.
RC_GTEST_PROP(LoadProperties, KeepsTheMomentum, ()) {
  const double mass_ratio = std::pow(10.0, between(-3.0, 2.0));
  const Case c = Case().friction_force(between(0.01, 0.5)).mass_ratio(mass_ratio);
  friction::LuGre<double> law;
  law.contact_stiffness = between(0.5, 20.0);
  law.static_friction = between(1.0, 1.8);
  law.stribeck_velocity = between(0.1, 1.0);
  law.bristle_damping = between(0.0, 0.2);
  law.viscous_friction = 0.3;
  auto solver = solver_of(c.loaded(law));
  RememberingState<friction::LuGre<double>, LoadedState<double>> state;
  state.velocity = between(-1.0, 1.0);
  state.sliding_velocity = between(-1.0, 1.0);
  const double before = state.sliding_velocity / mass_ratio - state.velocity;
  advance_without_error(solver, lasting(2.0 * turn), state);
  const double after = state.sliding_velocity / mass_ratio - state.velocity;
  RC_ASSERT(std::abs(after - before) < 1e-11 * (1.0 + 1.0 / mass_ratio));
}

// ---- Another integrator ----

using Peer = std::array<double, 5>;  // y, v, memory, r, z

/// The equations of LoadedModel as its docstring has them.
template <class Law>
Peer peer_state(const Loaded<Law>& model, const LoadedInterval<double>& span, const Peer& before) {
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
  return by_odeint(slope, before, span.duration, 1e-15);
}

Case random_case() {
  return Case()
      .friction_force(between(0.01, 0.5))
      .damping(between(0.0, 0.3))
      .stiffness(between(0.0, 2.0))
      .mass_ratio(std::pow(10.0, between(-2.0, 1.0)))
      .load_damping(between(0.0, 0.3))
      .load_stiffness(between(0.0, 0.5));
}

Course random_course(double duration) {
  const double force = between(-0.2, 0.2);
  const double force_rate = between(-0.02, 0.02);
  return lasting(duration)
      .driven(between(0.0, 1.5))
      .sliding(between(-0.5, 0.5))
      .accelerating(between(-0.02, 0.02))
      .pushed(force, force_rate);
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
  const Loaded<Law> model = random_case().loaded(law);
  const Course span = random_course(9.0);
  State before;
  before.displacement = between(-1.0, 1.0);
  before.velocity = between(-1.0, 1.0);
  contact_memory(before) = between(-1.0, 1.0);
  before.sliding_velocity = between(-1.0, 1.0);
  const Peer expected = peer_state(model, span,
                                   {before.displacement, before.velocity, contact_memory(before),
                                    before.sliding_velocity, before.extension});
  auto solver = solver_of(model);
  State state = before;
  LoadedEnergyAccount<double> account;
  advance_without_error(solver, span, state, account);
  expect_near(state, expected, 1e-9);
  RC_ASSERT(std::abs(account.balance_residual(model, before, state)) < 1e-10);
  RC_ASSERT(std::abs(account.load_residual(model, before, state)) < 1e-10);

  auto fixed = configured<Rk4<Loaded<Law>>>(model, 1e-3);
  State other = before;
  LoadedEnergyAccount<double> sums;
  advance_without_error(fixed, span, other, sums);
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
  const Loaded<Law> model = random_case().mass_ratio(between(0.01, 0.1)).loaded(law);
  const Course span = random_course(4.0).driven(between(0.0, 0.3));
  LoadedState<double> state;
  state.sliding_velocity = between(2.5, 3.5);
  const Peer expected = peer_state(model, span, {0.0, 0.0, 0.0, state.sliding_velocity, 0.0});
  auto solver = solver_of(model);
  advance_without_error(solver, span, state);
  RC_PRE(solver.cost().events == 0U);
  RC_ASSERT(std::abs(state.displacement - expected[0]) < 1e-9);
  RC_ASSERT(std::abs(state.sliding_velocity - expected[3]) < 1e-9);
  RC_ASSERT(std::abs(state.extension - expected[4]) < 1e-9);
}

/// Laws that stick or have corners: both solvers' balances, and an advance in parts.
template <class Law, class State>
void expect_balance(const Law& law) {
  const Loaded<Law> model = random_case().loaded(law);
  State before;
  before.displacement = between(-1.0, 1.0);
  before.velocity = between(-1.0, 1.0);
  before.sliding_velocity = between(-1.0, 1.0);
  const auto course = [drive = between(0.0, 1.5), pull = between(-0.5, 0.5),
                       force = between(-0.2, 0.2)](double duration) {
    return lasting(duration).driven(drive).sliding(pull).pushed(force);
  };
  auto solver = solver_of(model);
  State state = before;
  LoadedEnergyAccount<double> account;
  advance_without_error(solver, course(3.0 * turn), state, account);
  RC_ASSERT(std::abs(account.balance_residual(model, before, state)) < 1e-10);
  RC_ASSERT(std::abs(account.load_residual(model, before, state)) < 1e-10);
  RC_ASSERT(account.friction_work >= -1e-9);

  State other = before;
  for (int i = 0; i < 3; ++i) {
    advance_without_error(solver, course(turn), other);
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
  const double friction_force = 1e-7;  // hardly felt by the vibration
  const double mass_ratio = 1e-3;
  friction::Dahl<double> law;
  law.contact_stiffness = dahl_number;  // the vibration has unit amplitude
  auto solver = solver_of(Case().friction_force(friction_force).mass_ratio(mass_ratio).loaded(law));
  const Course period = lasting(turn).driven(1.0);
  for (const double ratio : {0.2, 0.5, 0.9}) {
    LoadedState<double> state;
    state.displacement = -1.0;  // of a free mass under cos: y = -cos
    state.sliding_velocity = ratio;
    for (int i = 0; i < 40; ++i) {  // until the contact has forgotten its beginning
      advance_without_error(solver, period, state);
    }
    const double before = state.sliding_velocity;
    const int periods = 200;
    for (int i = 0; i < periods; ++i) {
      advance_without_error(solver, period, state);
    }
    const double fall = (before - state.sliding_velocity) / (periods * turn);
    const double expected =
        mass_ratio * friction_force * friction::dahl_friction_ratio(ratio, dahl_number);
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
  const Case c = Case().friction_force(0.05).stiffness(50.0).damping(1.0).mass_ratio(0.1);
  auto solver = solver_of(c.load_stiffness(1e-3).loaded(law), 1e-10);
  const double pull = 0.01;
  LoadedState<double> state;
  Extremes seen;
  for (int i = 0; i < 1000; ++i) {
    const double before = state.extension;
    advance_without_error(solver, lasting(turn).driven(drive).sliding(pull), state);
    const double mean = 1.0 + (state.extension - before) / (turn * pull);
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
