/// Errors are named, placed in time, and never an endless loop.

#include <gtest/gtest.h>

#include <limits>

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::error_test {
namespace {

using Contact = DahlModel<double>;
using Taylor = EventTaylor<Contact, 12>;

template <class Solver>
Outcome<double> outcome(const typename Solver::Model& model, double setting,
                        const Interval<double>& interval, State<double> state) {
  auto solver = configured<Solver>(model, setting);
  NoAccount account;
  return advance(solver, interval, state, account);
}

const Contact ordinary = Case().contact_stiffness(1.0).friction_force(0.1).stiffness(0.5);
const Interval<double> period = lasting(2.0 * pi).driven(1.0).sliding(0.5);

TEST(SolverError, NoneReachesTheEndOfTheInterval) {
  EXPECT_EQ(outcome<Taylor>(ordinary, 1e-8, period, {}).offset, period.duration);
  EXPECT_EQ(outcome<Rk4<Contact>>(ordinary, 1e-2, period, {}).offset, period.duration);
}

TEST(SolverError, NotFinite) {
  const State<double> broken = {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};
  EXPECT_EQ(outcome<Taylor>(ordinary, 1e-8, period, broken).error, Error::not_finite);
  EXPECT_EQ(outcome<Rk4<Contact>>(ordinary, 1e-2, period, broken).error, Error::not_finite);
  const Contact unstable = Case().contact_stiffness(1.0).friction_force(0.1).stiffness(-1e6);
  const Outcome<double> grown = outcome<Taylor>(unstable, 1e-8, period, {1.0, 0.0, 0.0});
  EXPECT_EQ(grown.error, Error::not_finite);
  EXPECT_GT(grown.offset, 0.6);
  EXPECT_LT(grown.offset, 0.8);
}

TEST(SolverError, NotFiniteBeforeAStepLeavesTheStateAsItWas) {
  auto solver = configured<Taylor>(ordinary, 1e-8);
  NoAccount account;
  State<double> state = {0.25, 1.0, 0.5};
  const double endless = std::numeric_limits<double>::infinity();
  const auto refused = advance(solver, lasting(1.0).driven(endless).sliding(0.5), state, account);
  EXPECT_EQ(refused.error, Error::not_finite);
  EXPECT_EQ(refused.offset, 0.0);
  EXPECT_EQ(state.displacement, 0.25);
  EXPECT_EQ(state.velocity, 1.0);
  EXPECT_EQ(state.friction, 0.5);
  EXPECT_EQ(solver.cost().steps, 0U);
}

TEST(SolverError, FrictionBoundBrokenByRk4InAStiffContact) {
  const Contact stiff = Case().contact_stiffness(1e4).friction_force(0.1).stiffness(0.5);
  const Outcome<double> broken = outcome<Rk4<Contact>>(stiff, 1e-2, period, {});
  EXPECT_EQ(broken.error, Error::friction_bound_broken);
  EXPECT_GT(broken.offset, 0.0);
  EXPECT_LT(broken.offset, 0.1);
}

TEST(SolverError, TooManySteps) {
  const Contact ringing = Case().contact_stiffness(1e16).friction_force(10.0).stiffness(0.5);
  Taylor few;
  few.configure(ringing, 1e-8, 1000);
  NoAccount account;
  State<double> state;
  const auto stuck = advance(few, lasting(2.0 * pi).driven(1.0), state, account);
  EXPECT_EQ(stuck.error, Error::too_many_steps);
  EXPECT_LT(stuck.offset, period.duration);
  EXPECT_EQ(few.cost().steps, 1000U);
  EXPECT_EQ(outcome<Rk4<Contact>>(ordinary, 1e-9, period, {}).error, Error::too_many_steps);
}

}  // namespace
}  // namespace sonoglide::plant::error_test
