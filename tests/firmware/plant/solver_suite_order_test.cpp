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

double distance(const State<double>& a, const State<double>& b) {
  return std::abs(a.displacement - b.displacement) + std::abs(a.velocity - b.velocity) +
         std::abs(a.friction - b.friction);
}

struct Errors {
  double state;
  double mean_friction;
};

template <class Method>
Errors errors(const Case& c, const Course& course, double setting) {
  const Advanced exact = run_of<TaylorMethod<double, 16>>(c, course, start, 1e-16);
  const Advanced run = run_of<Method>(c, course, start, setting);
  EXPECT_EQ(run.error, Error::none);
  const double friction_error = run.account.friction_integral - exact.account.friction_integral;
  return {distance(run.state, exact.state), std::abs(friction_error) / course.duration()};
}

template <class Method>
double error(const Course& course, double setting) {
  const Errors found = errors<Method>(plant, course, setting);
  return found.state + found.mean_friction;
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

/// Over pieces of one step each.
template <std::size_t Order>
double error_in_pieces(int pieces) {
  const double length = sliding_on.duration() / pieces;
  State<double> state = start;
  for (int i = 0; i < pieces; ++i) {
    const Course piece = lasting(length).from_phase(0.3 + i * length).driven(0.7).sliding(3.0);
    state = run_of<TaylorMethod<double, Order>>(plant, piece, state, 1e20).state;
  }
  return distance(state, run_of<TaylorMethod<double, 16>>(plant, sliding_on, start, 1e-16).state);
}

template <std::size_t Order>
double taylor_order(int pieces) {
  return std::log2(error_in_pieces<Order>(pieces) / error_in_pieces<Order>(2 * pieces));
}

/// One more than the order of the force, whose integral the velocity is.
TEST(SolverOrder, TaylorHasThatOfItsSeriesBetweenReversals) {
  EXPECT_NEAR(taylor_order<4>(40), 5.0, 0.4);
  EXPECT_NEAR(taylor_order<8>(20), 9.0, 0.8);
  EXPECT_NEAR(taylor_order<12>(12), 13.0, 1.2);
}

TEST(SolverOrder, Rk4TendsToTheCoulombMeanInFirstOrder) {
  auto solver = configured<Rk4<CoulombModel<double>>>(Case(), 1e-3);
  State<double> state = {-1.0, 0.0, 0.0};
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, 10, 1.0, 0.5, state, account), Error::none);
  EXPECT_NEAR(account.friction_integral / (20.0 * pi), 1.0 / 3.0, 1e-3);
}

template <class Method>
void expect_tolerance_delivered(double loosest, double tightest, double factor) {
  for (double tolerance = loosest; tolerance > tightest; tolerance /= 10.0) {
    EXPECT_LT(error<Method>(reversing, tolerance), factor * tolerance + 1e-13) << Method::name();
  }
}

TEST(SolverOrder, TheToleranceIsDelivered) {
  expect_tolerance_delivered<TaylorMethod<double, 8>>(1e-4, 1e-13, 100.0);
  expect_tolerance_delivered<TaylorMethod<double, 12>>(1e-4, 1e-13, 100.0);
  expect_tolerance_delivered<TaylorMethod<double, 16>>(1e-4, 1e-13, 100.0);
  expect_tolerance_delivered<StrangMethod>(1e-2, 2e-8, 10.0);
}

TEST(SolverOrder, TheToleranceOfTaylorIsThatOfTheMeanFrictionHoweverStiffTheContact) {
  const Course course = lasting(20.0 * pi).driven(1.0).sliding(0.3);
  for (const double kappa : {0.4, 30.0, 3000.0, 1e6, 1e9}) {
    const Case c =
        Case().contact_stiffness(kappa).friction_force(0.05).damping(0.1).stiffness(0.05);
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      EXPECT_LT((errors<TaylorMethod<double, 8>>(c, course, tolerance).mean_friction),
                10.0 * tolerance)
          << kappa;
      EXPECT_LT((errors<TaylorMethod<double, 12>>(c, course, tolerance).mean_friction),
                10.0 * tolerance)
          << kappa;
    }
  }
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
