/// The panels of the Gauss method: when they serve, what they are worth, what they leave to Taylor.

#include "firmware/plant/gauss/event_gauss.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/common/dice/dice.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::event_gauss_test {
namespace {

using Contact = DampedDahlModel<double>;
using Gauss8 = EventGauss<Contact, 8>;
using Gauss12 = EventGauss<Contact, 12>;
using Taylor16 = EventTaylor<Contact, 16>;

constexpr double period = 2.0 * pi;
const Contact weak =
    Case().contact_stiffness(0.4).friction_force(5e-5).damping(0.01).stiffness(0.05);
const Interval<double> ordinary =
    lasting(period).from_phase(0.3).driven(1.0).sliding(0.5).accelerating(0.002);
const State<double> start = {0.1, 0.2, -0.3};

struct Reached {
  State<double> state;
  EnergyAccount<double> account;
  Cost cost;
};

template <class Solver>
Reached reached(const Contact& model, double tolerance, const Interval<double>& interval,
                const State<double>& from) {
  auto solver = configured<Solver>(model, tolerance);
  Reached run;
  run.state = from;
  EXPECT_EQ(advance(solver, interval, run.state, run.account).error, Error::none);
  run.cost = solver.cost();
  return run;
}

/// Weakly coupled plants.
class Plants : public tests::Dice {
 public:
  Plants() : Dice(5489) {}

  Contact model() {
    const double kappa = decades(1e-3, 10.0);
    const double beta = decades(1e-8, 1e-3) / std::fmax(1.0, kappa);
    const double sigma = sign();
    const double damping = decades(1e-3, 2.0);
    return Case()
        .contact_stiffness(kappa)
        .friction_force(beta)
        .vibration_sign(sigma)
        .damping(chance(0.5) ? 0.0 : damping)
        .stiffness(decades(1e-3, 2.0));
  }
  Interval<double> interval() {
    const double acceleration = chance(0.5) ? 0.0 : between(-0.02, 0.02);
    return lasting(period)
        .from_phase(between(0.0, 6.28))
        .driven(between(0.1, 2.0))
        .sliding(between(-1.5, 1.5))
        .accelerating(acceleration);
  }
  State<double> state() { return {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)}; }
};

/// Against another method; returns whether one panel did.
template <class Solver>
bool agrees(Plants& any, double tolerance) {
  const Contact model = any.model();
  const Interval<double> interval = any.interval();
  const State<double> before = any.state();
  const Reached run = reached<Solver>(model, tolerance, interval, before);
  const Reached exact = reached<Taylor16>(model, 1e-15, interval, before);
  if (run.cost.steps != 1) {
    return false;
  }
  EXPECT_NEAR(run.account.friction_integral, exact.account.friction_integral,
              2.0 * period * tolerance);
  EXPECT_EQ(run.cost.events, exact.cost.events);
  EXPECT_NEAR(run.state.displacement, exact.state.displacement, tolerance);
  EXPECT_NEAR(run.state.velocity, exact.state.velocity, tolerance);
  EXPECT_NEAR(run.state.friction, exact.state.friction, tolerance);
  EXPECT_NEAR(run.account.friction_work, exact.account.friction_work, tolerance);
  EXPECT_NEAR(run.account.sliding_work, exact.account.sliding_work, 20.0 * tolerance);
  EXPECT_NEAR(run.account.drive_work, exact.account.drive_work, 10.0 * tolerance);
  EXPECT_NEAR(run.account.damping_work, exact.account.damping_work, 10.0 * tolerance);
  EXPECT_NEAR(run.account.velocity_square, exact.account.velocity_square, 20.0 * tolerance);
  EXPECT_NEAR(run.account.displacement_square, exact.account.displacement_square,
              100.0 * tolerance);
  EXPECT_LE(std::abs(run.state.friction), 1.0);
  EXPECT_NEAR(run.account.balance_residual(model, before, run.state), 0.0, 100.0 * tolerance);
  return true;
}

template <class Solver>
void expect_agreement(double tolerance) {
  Plants any;
  int panels = 0;
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    panels += agrees<Solver>(any, tolerance) ? 1 : 0;
  }
  EXPECT_GT(panels, 600);
}

TEST(EventGauss, AgreesWithTaylorToItsTolerance) {
  expect_agreement<Gauss8>(1e-5);
  expect_agreement<Gauss8>(1e-8);
  expect_agreement<Gauss12>(1e-10);
}

template <class Solver>
void expect_same_bits(double tolerance) {
  using numeric::VectorUnit;
  Plants any;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const Contact model = any.model();
    const Interval<double> interval = any.interval();
    const State<double> before = any.state();
    const Reached best = reached<Solver>(model, tolerance, interval, before);
    for (const VectorUnit unit : {VectorUnit::any, VectorUnit::avx2}) {
      if (unit > numeric::best_vector_unit()) {
        continue;
      }
      auto solver = configured<Solver>(model, tolerance);
      solver.use(unit);
      State<double> state = before;
      EnergyAccount<double> account;
      EXPECT_EQ(advance(solver, interval, state, account).error, Error::none);
      EXPECT_EQ(state.displacement, best.state.displacement);
      EXPECT_EQ(state.velocity, best.state.velocity);
      EXPECT_EQ(state.friction, best.state.friction);
      EXPECT_EQ(account.friction_integral, best.account.friction_integral);
      EXPECT_EQ(account.drive_work, best.account.drive_work);
    }
  }
}

TEST(EventGauss, HasTheSameBitsOnEveryVectorUnit) {
  expect_same_bits<Gauss8>(1e-6);
  expect_same_bits<Gauss12>(1e-10);
}

TEST(EventGauss, IsOneStepForACarrierPeriodOfAWeakContact) {
  const Reached run = reached<Gauss8>(weak, 1e-8, ordinary, start);
  EXPECT_EQ(run.cost.steps, 1U);
  EXPECT_EQ(run.cost.events, 2U);
}

/// Without reaction of friction the oscillator moves alone: over carrier periods, each of them a
/// panel and none of it Taylor's.
template <class Solver>
State<double> oscillator_after_panels(const Case& oscillator, int periods,
                                      const State<double>& from, double tolerance) {
  auto solver = configured<Solver>(oscillator.contact_stiffness(0.02), tolerance);
  State<double> state = from;
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, periods, 1.0, 0.5, state, account), Error::none);
  EXPECT_EQ(solver.cost().steps, static_cast<std::uint64_t>(periods));
  return state;
}

template <class Solver>
void expect_the_oscillator(double tolerance) {
  constexpr int periods = 3;
  constexpr double duration = periods * period;
  const double k = 0.37;
  const double w = std::sqrt(k);
  const State<double> driven =
      oscillator_after_panels<Solver>(Case().stiffness(k), periods, {}, tolerance);
  EXPECT_NEAR(driven.displacement, (1.0 - std::cos(w * duration)) / (k - 1.0), tolerance);
  EXPECT_NEAR(driven.velocity, w * std::sin(w * duration) / (k - 1.0), tolerance);

  const State<double> resonant =
      oscillator_after_panels<Solver>(Case().stiffness(1.0), periods, {}, tolerance);
  EXPECT_NEAR(resonant.displacement, 0.0, tolerance);
  EXPECT_NEAR(resonant.velocity, 0.5 * duration, tolerance);

  const State<double> orbit = {1.0 / (k - 1.0), 0.0, 0.0};
  const State<double> steady =
      oscillator_after_panels<Solver>(Case().stiffness(k), periods, orbit, tolerance);
  EXPECT_NEAR(steady.displacement, orbit.displacement, tolerance);
  EXPECT_NEAR(steady.velocity, 0.0, tolerance);

  // y = Re(exp(i tau) / (k - 1 + i d)) on the damped orbit.
  const double d = 0.2;
  const double square = (k - 1.0) * (k - 1.0) + d * d;
  const State<double> damped_orbit = {(k - 1.0) / square, d / square, 0.0};
  const State<double> damped = oscillator_after_panels<Solver>(Case().damping(d).stiffness(k),
                                                               periods, damped_orbit, tolerance);
  EXPECT_NEAR(damped.displacement, damped_orbit.displacement, tolerance);
  EXPECT_NEAR(damped.velocity, damped_orbit.velocity, tolerance);
}

TEST(EventGauss, MovesTheOscillatorAsInClosedForm) {
  expect_the_oscillator<Gauss8>(1e-8);
  expect_the_oscillator<Gauss12>(1e-10);
}

/// Whatever is no panel is Taylor's, bit for bit.
void expect_taylor(const Contact& model, const Interval<double>& interval,
                   const State<double>& from) {
  const Reached run = reached<Gauss8>(model, 1e-8, interval, from);
  const Reached taylor = reached<EventTaylor<Contact, 12>>(model, 1e-8, interval, from);
  EXPECT_EQ(run.state.displacement, taylor.state.displacement);
  EXPECT_EQ(run.state.velocity, taylor.state.velocity);
  EXPECT_EQ(run.state.friction, taylor.state.friction);
  EXPECT_EQ(run.account.friction_integral, taylor.account.friction_integral);
  EXPECT_EQ(run.account.drive_work, taylor.account.drive_work);
  EXPECT_EQ(run.cost.steps, taylor.cost.steps);
}

TEST(EventGauss, LeavesToTaylorWhatIsNoPanel) {
  expect_taylor(weak, lasting(0.9 * period).from_phase(0.3).driven(1.0).sliding(0.5), start);
  expect_taylor(weak, lasting(3.0 * period).from_phase(0.3).driven(1.0).sliding(0.5), start);
  Contact strong = weak;
  strong.friction_force = 0.3;
  expect_taylor(strong, ordinary, start);
  Contact saturating = weak;
  saturating.law.contact_stiffness = 100.0;
  saturating.friction_force = 1e-9;
  expect_taylor(saturating, ordinary, start);
  Contact fast = weak;
  fast.stiffness = 400.0;
  expect_taylor(fast, ordinary, start);
}

TEST(EventGauss, LeavesToTaylorReversalsThatAreNotCertain) {
  const Contact bare = Case().contact_stiffness(0.4);
  // V = r + sin(tau): zero at the beginning, at the end, touching zero, and all but touching it.
  expect_taylor(bare, lasting(period).driven(1.0), {-1.0, 0.0, 0.0});
  expect_taylor(bare, lasting(period).driven(1.0).sliding(1e-6), {-1.0, 0.0, 0.0});
  expect_taylor(bare, lasting(period).driven(1.0).sliding(1.0), {-1.0, 0.0, 0.0});
  expect_taylor(bare, lasting(period).driven(1.0).sliding(1.0001), {-1.0, 0.0, 0.0});
}

TEST(EventGauss, LeavesToTaylorAMotionThatRoundingWouldLose) {
  // A mass that hardly moves about a place far off; a fast slide over a mass that hardly moves; and
  // one over a contact so soft that the energy is lost beside what the slide spends.
  expect_taylor(Case().contact_stiffness(4e11).friction_force(5e-21).damping(3e-6),
                lasting(period).driven(2e-17).sliding(2e-13), {1.0, 0.0, 0.0});
  expect_taylor(Case().contact_stiffness(5e-14).friction_force(1.0).damping(8e-6).stiffness(2e-6),
                lasting(period).driven(1e-6).sliding(46.0), {});
  expect_taylor(Case().contact_stiffness(6e-15).friction_force(1.0),
                lasting(period).driven(2e-7).sliding(158.0), {0.0, 9e-4, 0.0});
}

TEST(EventGauss, TellsOfAStateThatIsNotFinite) {
  auto solver = configured<Gauss8>(weak, 1e-8);
  State<double> state = {std::nan(""), 0.0, 0.0};
  NoAccount account;
  EXPECT_EQ(advance(solver, ordinary, state, account).error, Error::not_finite);
}

TEST(EventGauss, TheStepLimitIsTaylors) {
  Gauss8 solver;
  solver.configure(weak, 1e-8, 2);
  State<double> state;
  NoAccount account;
  EXPECT_EQ(advance(solver, ordinary, state, account).error, Error::none);
  EXPECT_EQ(advance(solver, lasting(3.0 * period).driven(1.0).sliding(0.5), state, account).error,
            Error::too_many_steps);
}

TEST(EventGauss, SolvesAnUndrivenContact) {
  using Undriven = Model<friction::Dahl<double>, Undamped<double>, NoDrive>;
  const Undriven model = Case().contact_stiffness(0.7).friction_force(1e-5).stiffness(0.1);
  auto gauss = configured<EventGauss<Undriven, 8>>(model, 1e-8);
  auto taylor = configured<EventTaylor<Undriven, 16>>(model, 1e-15);
  const Interval<double> interval = lasting(period).sliding(0.1);
  const State<double> before = {0.4, 0.3, 0.2};
  State<double> state = before;
  EnergyAccount<double> account;
  ASSERT_EQ(advance(gauss, interval, state, account).error, Error::none);
  EXPECT_EQ(gauss.cost().steps, 1U);
  const State<double> exact = advanced(taylor, interval, before);
  EXPECT_NEAR(state.displacement, exact.displacement, 1e-9);
  EXPECT_NEAR(state.velocity, exact.velocity, 1e-9);
  EXPECT_NEAR(state.friction, exact.friction, 1e-9);
  EXPECT_NEAR(account.balance_residual(model, before, state), 0.0, 1e-8);
}

TEST(EventGauss, MirroredMotionIsTheMirrorImageBitForBit) {
  const Reached one = reached<Gauss8>(weak, 1e-8, ordinary, start);
  const Reached other = reached<Gauss8>(
      weak, 1e-8, lasting(period).from_phase(0.3).driven(-1.0).sliding(-0.5).accelerating(-0.002),
      {-0.1, -0.2, 0.3});
  EXPECT_EQ(one.cost.steps, 1U);
  EXPECT_EQ(one.state.displacement, -other.state.displacement);
  EXPECT_EQ(one.state.velocity, -other.state.velocity);
  EXPECT_EQ(one.state.friction, -other.state.friction);
  EXPECT_EQ(one.account.drive_work, other.account.drive_work);
}

}  // namespace
}  // namespace sonoglide::plant::event_gauss_test
