/// Runge–Kutta with located reversals: their place, and what it cannot do.

#include "firmware/plant/rk4/rk4_event.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::rk4_event_test {
namespace {

using Contact = DahlModel<double>;
using Solver = Rk4Event<Contact>;

static_assert(Solver::solves<friction::Dahl<double>>);
static_assert(Solver::solves<friction::None<double>>);
static_assert(!Solver::solves<friction::Coulomb<double>>);
static_assert(Rk4<Contact>::solves<friction::Coulomb<double>>);

/// No reaction of friction and no spring: from rest v = a sin(tau), V = r + a sin(tau).
const Contact prescribed = Case().contact_stiffness(0.5);

/// V = r + sin(tau) is zero at pi + asin(r) and 2 pi - asin(r): steps end there, to the error of
/// the method.
TEST(Rk4EventReversal, StepsEndAtTheReversals) {
  const double r = 0.3;
  auto solver = configured<Solver>(prescribed, 0.05);
  State<double> state;
  NoAccount account;
  std::vector<double> ends;
  auto watch = [&](const auto& step) { ends.push_back(step.begin() + step.length()); };
  ASSERT_EQ(solver.advance(lasting(2.0 * pi).driven(1.0).sliding(r), state, account, watch).error,
            Error::none);
  for (const double reversal : {pi + std::asin(r), 2.0 * pi - std::asin(r)}) {
    double nearest = 1.0;
    for (const double end : ends) {
      nearest = std::fmin(nearest, std::abs(end - reversal));
    }
    EXPECT_LT(nearest, 2e-8);
  }
}

/// A reversal on the very boundary of an interval, and one just before it.
TEST(Rk4EventReversal, AtTheEndOfAnInterval) {
  for (const double cut : {0.0, 1e-16, 1e-12, 1e-7, -1e-7}) {
    auto solver = configured<Solver>(prescribed, 0.05);
    const double first = pi + std::asin(0.3) + cut;
    State<double> state = advanced(solver, lasting(first).driven(1.0).sliding(0.3), {});
    state = advanced(solver, lasting(2.0 * pi - first).from_phase(first).driven(1.0).sliding(0.3),
                     state);
    const State<double> whole = advanced(solver, lasting(2.0 * pi).driven(1.0).sliding(0.3), {});
    EXPECT_NEAR(state.friction, whole.friction, 1e-7) << cut;
  }
}

/// Single precision: grazing intervals neither lose a reversal for good nor stand still.
TEST(Rk4EventReversal, SinglePrecisionAlwaysGoesOn) {
  using Single = DahlModel<float>;
  for (int i = 0; i < 400; ++i) {
    const float r = 0.9F + 0.0005F * static_cast<float>(i);
    for (const double sign : {1.0, -1.0}) {
      const Single model =
          Case().contact_stiffness(0.4).friction_force(0.01).vibration_sign(sign).stiffness(0.05);
      Rk4Event<Single> solver;
      solver.configure(model, 0.1F, 200);
      State<float> state;
      NoAccount account;
      ASSERT_EQ(run_periods(solver, 5, 1.0F, r, state, account), Error::none) << r;
    }
  }
}

TEST(Rk4EventError, AStiffContactIsReportedNotGuessed) {
  // kappa |V| step = 2: stable, and wrong by more than the friction itself.
  auto solver = configured<Solver>(Case().contact_stiffness(20.0), 0.1);
  State<double> state;
  NoAccount account;
  const Outcome<double> outcome = advance(solver, lasting(1.0).sliding(1.0), state, account);
  EXPECT_EQ(outcome.error, Error::step_too_long);
  EXPECT_EQ(outcome.offset, 0.0);
  EXPECT_EQ(state.friction, 0.0);
}

TEST(Rk4EventError, AFullySlidingStiffContactIsNoTrouble) {
  auto solver = configured<Solver>(Case().contact_stiffness(1e9).friction_force(1e-12), 0.1);
  State<double> state = {0.0, 0.0, 1.0};
  MeanFriction<double> account;
  EXPECT_EQ(advance(solver, lasting(20.0).driven(0.5).sliding(1.0), state, account).error,
            Error::none);
  EXPECT_EQ(state.friction, 1.0);
  EXPECT_NEAR(account.friction_integral, 20.0, 1e-12);
}

TEST(Rk4EventError, ARingingThatTheStepCannotFollow) {
  auto solver = configured<Solver>(Case().contact_stiffness(1e4).friction_force(0.5), 0.02);
  State<double> state = {1e-11, 0.0, 1e-7};
  NoAccount account;
  EXPECT_EQ(advance(solver, lasting(1.0), state, account).error, Error::step_too_long);
}

}  // namespace
}  // namespace sonoglide::plant::rk4_event_test
