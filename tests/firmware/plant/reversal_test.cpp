/// Reversals of the sliding velocity: their number and place, and the degenerate ones.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::reversal_test {
namespace {

using Contact = DahlModel<double>;
using Taylor = EventTaylor<Contact, 12>;

/// No reaction of friction and no spring: from rest v = a sin(tau), V = r + a sin(tau).
const Contact prescribed = Case().contact_stiffness(2.0);

std::uint64_t reversals(double drive_amplitude, double sliding_velocity, double periods) {
  auto solver = configured<Taylor>(prescribed, 1e-12);
  const Interval<double> interval =
      lasting(periods * 2.0 * pi).driven(drive_amplitude).sliding(sliding_velocity);
  NoAccount account;
  State<double> state;
  EXPECT_EQ(advance(solver, interval, state, account).error, Error::none);
  return solver.cost().events;
}

TEST(Reversal, TwoInEachPeriodOfAVibrationThatIsFaster) {
  for (const double r : {0.5, -0.5, 0.01, -0.99}) {
    EXPECT_EQ(reversals(1.0, r, 10.0), 20U) << r;
  }
}

TEST(Reversal, NoneWhereTheVibrationIsSlower) {
  EXPECT_EQ(reversals(1.0, 1.0001, 10.0), 0U);
  EXPECT_EQ(reversals(1.0, -7.0, 10.0), 0U);
  EXPECT_EQ(reversals(0.0, 0.5, 10.0), 0U);
}

TEST(Reversal, APairCloseTogetherIsNotSkipped) {
  for (const double excess : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    EXPECT_EQ(reversals(1.0, 1.0 - excess, 10.0), 20U) << excess;
    EXPECT_EQ(reversals(1.0, excess - 1.0, 10.0), 20U) << excess;
  }
}

TEST(Reversal, GrazingEnds) {
  auto solver = configured<Taylor>(prescribed, 1e-12);
  State<double> state;
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, 20, 1.0, 1.0, state, account), Error::none);
  EXPECT_GE(solver.cost().steps, 20U);
  EXPECT_LT(solver.cost().steps, 1000U);
  EXPECT_NEAR(state.friction, 1.0, 1e-12);
  // V >= 0 throughout: u = r tau + 1 - cos(tau), e = exp(-2 u).
  const double touch = 1.5 * pi;
  const State<double> at_touch = advanced(solver, lasting(touch).driven(0.01).sliding(0.01), {});
  EXPECT_NEAR(at_touch.friction, 1.0 - std::exp(-2.0 * 0.01 * (touch + 1.0)), 1e-12);
}

TEST(Reversal, FromRestWithAnAcceleration) {
  for (const double a : {1.0, -1.0}) {
    auto solver = configured<Taylor>(prescribed, 1e-12);
    const State<double> end = advanced(solver, lasting(1.0).driven(a), {});
    const double friction = 1.0 - std::exp(-2.0 * (1.0 - std::cos(1.0)));
    EXPECT_NEAR(end.friction, a * friction, 1e-13);
    EXPECT_EQ(solver.cost().events, 0U);
  }
}

/// V = v, v(0) = 0 and v'(0) = cos(pi / 2) = 0: the direction is that of v''.
TEST(Reversal, FromRestWithoutAnAcceleration) {
  for (const double a : {1.0, -1.0}) {
    auto solver = configured<Taylor>(prescribed, 1e-12);
    const State<double> end = advanced(solver, lasting(1.0).from_phase(0.5 * pi).driven(a), {});
    EXPECT_NEAR(end.displacement, a * (std::sin(1.0) - 1.0), 1e-13);
    const double friction = 1.0 - std::exp(-2.0 * (1.0 - std::sin(1.0)));
    EXPECT_NEAR(end.friction, -a * friction, 1e-13);
  }
}

TEST(Reversal, AtRestWithoutAnyForceNothingMoves) {
  const Contact model = Case().contact_stiffness(1e4).friction_force(0.3);
  auto solver = configured<Taylor>(model, 1e-12);
  const State<double> end = advanced(solver, lasting(50.0), {});
  EXPECT_EQ(end.displacement, 0.0);
  EXPECT_EQ(end.velocity, 0.0);
  EXPECT_EQ(end.friction, 0.0);
  EXPECT_GE(solver.cost().steps, 1U);
  EXPECT_LT(solver.cost().steps, 200U);
}

/// The pull turns round: V = r0 + r1 tau, u = tau^2 / 2 on either side of the turn.
TEST(Reversal, SlidingVelocityThroughZero) {
  for (const double direction : {1.0, -1.0}) {
    auto solver = configured<Taylor>(prescribed, 1e-12);
    const State<double> end =
        advanced(solver, lasting(2.5).sliding(-direction).accelerating(direction), {0.0, 0.0, 0.0});
    const double at_turn = -(1.0 - std::exp(-2.0 * 0.5));
    const double friction = 1.0 - (1.0 - at_turn) * std::exp(-2.0 * 0.5 * 1.5 * 1.5);
    EXPECT_NEAR(end.friction, direction * friction, 1e-13);
    EXPECT_EQ(solver.cost().events, 1U);
  }
}

/// A stuck contact that rings many times in each carrier period.
TEST(Reversal, ManyInEachPeriodAgreeWithSmallFixedSteps) {
  const Contact model = Case().contact_stiffness(3e3).friction_force(0.9).stiffness(0.1);
  const Interval<double> interval = lasting(2.0 * pi).driven(0.4);
  const State<double> start = {0.0, 0.01, 0.0};
  auto taylor = configured<EventTaylor<Contact, 16>>(model, 1e-14);
  auto rk4 = configured<Rk4<Contact>>(model, 1e-5);
  State<double> exact = start;
  State<double> fixed = start;
  MeanFriction<double> exact_account;
  MeanFriction<double> fixed_account;
  EXPECT_EQ(advance(taylor, interval, exact, exact_account).error, Error::none);
  EXPECT_EQ(advance(rk4, interval, fixed, fixed_account).error, Error::none);
  EXPECT_GT(taylor.cost().events, 50U);
  EXPECT_LE(taylor.cost().events, 110U);  // 2 sqrt(beta kappa) = 104 by the ringing
  EXPECT_NEAR(exact.displacement, fixed.displacement, 1e-9);
  EXPECT_NEAR(exact.friction, fixed.friction, 1e-5);
  EXPECT_NEAR(exact_account.friction_integral, fixed_account.friction_integral, 1e-6);
}

TEST(Reversal, MirroredMotionIsTheMirrorImageBitForBit) {
  const Contact model = Case().contact_stiffness(40.0).friction_force(0.2).stiffness(0.3);
  auto solver = configured<Taylor>(model, 1e-9);
  const State<double> one =
      advanced(solver, lasting(6.0).from_phase(0.3).driven(1.0).sliding(0.2).accelerating(0.03),
               {0.1, -0.2, 0.4});
  const State<double> other =
      advanced(solver, lasting(6.0).from_phase(0.3).driven(-1.0).sliding(-0.2).accelerating(-0.03),
               {-0.1, 0.2, -0.4});
  EXPECT_EQ(one.displacement, -other.displacement);
  EXPECT_EQ(one.velocity, -other.velocity);
  EXPECT_EQ(one.friction, -other.friction);
}

}  // namespace
}  // namespace sonoglide::plant::reversal_test
