/// What the solver said comes first; then what it should have said.

#include "host_sim/studies/stability/trial.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace sonoglide::stability::trial_test {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Verdict judged(const TrialResult& result, double error = 0.0) {
  return judge(result, error, 1e-3, 1.0);
}

TrialResult bounded(double largest_friction) {
  TrialResult result;
  result.largest_friction = largest_friction;
  return result;
}

TrialResult declined(plant::Error error) {
  TrialResult result = bounded(5.0);
  result.finite = false;
  result.error = error;
  return result;
}

TEST(Verdict, WhatTheSolverReportsIsNotSilent) {
  EXPECT_EQ(judged(declined(plant::Error::not_finite)), Verdict::declined_not_finite);
  EXPECT_EQ(judged(declined(plant::Error::friction_bound_broken)),
            Verdict::declined_friction_bound);
  EXPECT_EQ(judged(declined(plant::Error::step_too_long)), Verdict::declined_step_too_long);
  EXPECT_EQ(judged(declined(plant::Error::too_many_steps)), Verdict::declined_too_many_steps);
}

TEST(Verdict, WhatItKeepsToItselfIs) {
  EXPECT_EQ(judged(bounded(1.0 + 1e-15)), Verdict::silent_friction_bound);
  EXPECT_EQ(judged(bounded(none)), Verdict::silent_friction_bound);
  TrialResult result;
  result.finite = false;
  EXPECT_EQ(judged(result), Verdict::silent_not_finite);
}

TEST(Verdict, TheErrorDecidesTheRest) {
  EXPECT_EQ(judged(bounded(1.0), 1e-3), Verdict::good);
  EXPECT_EQ(judged(bounded(1.0), 1.001e-3), Verdict::wrong);
  EXPECT_EQ(judged(bounded(1.0), none), Verdict::wrong);
}

TEST(Verdict, ASolverMayRefuseALaw) {
  TrialResult result;
  result.supported = false;
  EXPECT_EQ(judged(result), Verdict::unsupported);
}

}  // namespace
}  // namespace sonoglide::stability::trial_test
