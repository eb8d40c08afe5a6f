/// Order of convergence of every solver, between reversals and across them.

#include <gtest/gtest.h>

#include <cmath>

#include "solver_suite.hpp"

namespace sonoglide::plant::solver_suite_order_test {
namespace {

const Case plant = Case().contact_stiffness(0.9).friction_force(0.3).damping(0.2).stiffness(0.6);
const State<double> start = {0.2, -0.1, 0.3};
const Course sliding_on = lasting(4.0).from_phase(0.3).driven(0.7).sliding(3.0);
const Course reversing = lasting(25.0).from_phase(0.3).driven(1.0).sliding(0.3);

/// What is compared: the state, and the mean of phi.
double distance(const Advanced& a, const Advanced& b, double duration) {
  return std::abs(a.state.displacement - b.state.displacement) +
         std::abs(a.state.velocity - b.state.velocity) +
         std::abs(a.state.friction - b.state.friction) +
         std::abs(a.account.friction_integral - b.account.friction_integral) / duration;
}

template <class Method>
double error(const Course& course, double setting) {
  const Advanced exact = run_of<TaylorMethod<double, 16>>(plant, course, start, 1e-16);
  const Advanced run = run_of<Method>(plant, course, start, setting);
  EXPECT_EQ(run.error, Error::none);
  return distance(run, exact, course.duration());
}

/// Mean order over a range of steps; single errors across reversals scatter with where these fall.
template <class Method>
double order(const Course& course, double coarse, double fine) {
  return std::log(error<Method>(course, coarse) / error<Method>(course, fine)) /
         std::log(coarse / fine);
}

TEST(SolverOrder, BetweenReversals) {
  EXPECT_NEAR(order<Rk4Method<double>>(sliding_on, 0.04, 0.02), 4.0, 0.1);
  EXPECT_NEAR(order<Rk4EventMethod<double>>(sliding_on, 0.04, 0.02), 4.0, 0.1);
  EXPECT_NEAR(order<EqualStepStrangMethod<double>>(sliding_on, 0.04, 0.02), 2.0, 0.05);
}

TEST(SolverOrder, AcrossReversals) {
  EXPECT_NEAR(order<Rk4Method<double>>(reversing, 0.1, 0.001), 2.0, 0.5);
  EXPECT_NEAR(order<Rk4EventMethod<double>>(reversing, 0.1, 0.01), 4.0, 0.2);
  EXPECT_NEAR(order<EqualStepStrangMethod<double>>(reversing, 0.1, 0.01), 2.0, 0.1);
}

/// Each halving gains, down to rounding; there the error stays.
TEST(SolverOrder, HalvingTheStepGainsUntilRounding) {
  double last = 1.0;
  for (double step = 0.1; step > 1e-4; step /= 2.0) {
    const double found = error<Rk4EventMethod<double>>(reversing, step);
    EXPECT_LT(found, 0.1 * last + 3e-11) << step;
    last = found;
  }
  last = 1.0;
  for (double step = 0.1; step > 1e-4; step /= 2.0) {
    const double found = error<EqualStepStrangMethod<double>>(reversing, step);
    EXPECT_LT(found, 0.4 * last + 3e-11) << step;
    last = found;
  }
}

template <class Method>
void expect_tolerance_delivered() {
  for (double tolerance = 1e-4; tolerance > 1e-13; tolerance /= 10.0) {
    EXPECT_LT(error<Method>(reversing, tolerance), 100.0 * tolerance + 1e-13) << Method::name();
  }
}

TEST(SolverOrder, TheToleranceOfTaylorIsDelivered) {
  expect_tolerance_delivered<TaylorMethod<double, 8>>();
  expect_tolerance_delivered<TaylorMethod<double, 12>>();
  expect_tolerance_delivered<TaylorMethod<double, 16>>();
}

/// Without reaction of friction the splitting has no error; its paths are of sixth order.
TEST(SolverOrder, SplittingIsOfSixthOrderWithoutReaction) {
  const Case prescribed = Case().contact_stiffness(0.9).damping(0.2).stiffness(0.6);
  const auto friction_error = [&](double step) {
    const State<double> exact =
        run_of<TaylorMethod<double, 16>>(prescribed, reversing, start, 1e-16).state;
    const State<double> state =
        run_of<EqualStepStrangMethod<double>>(prescribed, reversing, start, step).state;
    EXPECT_NEAR(state.displacement, exact.displacement, 1e-12);
    EXPECT_NEAR(state.velocity, exact.velocity, 1e-12);
    return std::abs(state.friction - exact.friction);
  };
  EXPECT_GT(std::log2(friction_error(0.4) / friction_error(0.05)) / 3.0, 5.0);
}

}  // namespace
}  // namespace sonoglide::plant::solver_suite_order_test
