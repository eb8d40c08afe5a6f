/// The budget of the solvers that take equal steps.

#include "firmware/plant/state.hpp"

#include <gtest/gtest.h>

#include "firmware/plant/rk4/rk4_event.hpp"
#include "firmware/plant/strang/equal_step_strang.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::state_test {
namespace {

using Contact = DahlModel<double>;

/// No reaction of friction and no spring: from rest v = a sin(tau), V = r + a sin(tau).
const Contact prescribed = Case().contact_stiffness(0.5);

template <class FixedStep>
void expect_budget_kept() {
  FixedStep solver;
  solver.configure(prescribed, 0.1, 62);
  State<double> state;
  NoAccount account;
  NoObserver observer;
  const Interval<double> period = lasting(2.0 * pi).driven(1.0).sliding(0.5);
  const Outcome<double> outcome = solver.advance(period, state, account, observer);
  EXPECT_EQ(outcome.error, Error::too_many_steps);
  EXPECT_EQ(outcome.offset, 0.0);
  EXPECT_EQ(solver.cost().steps, 0U) << "known before the first step";
}

TEST(FixedStepBudget, IsKnownBeforeTheFirstStep) {
  expect_budget_kept<Rk4<Contact>>();
  expect_budget_kept<Rk4Event<Contact>>();
  expect_budget_kept<EqualStepStrang<Contact>>();
}

TEST(FixedStepBudget, CountsThePartsOfCutSteps) {
  Rk4Event<Contact> solver;
  solver.configure(prescribed, 0.1, 64);
  State<double> state;
  NoAccount account;
  const Outcome<double> outcome =
      advance(solver, lasting(2.0 * pi).driven(1.0).sliding(0.5), state, account);
  EXPECT_EQ(outcome.error, Error::too_many_steps);
  EXPECT_GT(outcome.offset, 6.0);
  EXPECT_EQ(solver.cost().steps, 64U);
}

TEST(FixedStepBudget, StepsThatFitButForRoundingFit) {
  EXPECT_EQ(fixed_step_count(1.0, 0.1, 100U), 10U);
  EXPECT_EQ(fixed_step_count(1.0, 0.0999, 100U), 11U);
  EXPECT_EQ(fixed_step_count(0.0, 0.1, 100U), 0U);
  EXPECT_EQ(fixed_step_count(1.0, 0.1, 9U), 10U);
  EXPECT_EQ(fixed_step_count(1e300, 1e-300, 9U), 10U);
}

}  // namespace
}  // namespace sonoglide::plant::state_test
