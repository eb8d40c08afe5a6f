/// The splitting that checks itself: what it hands over is within its tolerance, the rest it
/// declines.

#include "firmware/plant/strang/strang.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdint>

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::strang_test {
namespace {

static_assert(Strang<DahlModel<double>>::solves<friction::Dahl<double>>);
static_assert(!Strang<DahlModel<double>>::solves<friction::Coulomb<double>>);

using Contact = DampedDahlModel<double>;
using Solver = Strang<Contact>;
using Taylor = EventTaylor<Contact, 16>;

constexpr double period = 2.0 * pi;
const Contact ordinary =
    Case().contact_stiffness(0.9).friction_force(0.3).damping(0.2).stiffness(0.6);
const State<double> start = {0.2, -0.1, 0.3};

/// The integrals, and the energies that went through the steps, each with its magnitude.
struct Passed : EnergyAccount<double> {
  double drive = 0.0;
  double damper = 0.0;
  double contact = 0.0;  ///< over beta
  double velocity_square_at_most = 0.0;

  template <class Step>
  void add(const Step& step) {
    EnergyAccount<double>::add(step);
    drive += std::abs(step.motion_integrals().drive_work);
    damper += std::abs(step.motion_integrals().damping_work);
    contact += std::abs(step.friction_work() - step.sliding_work());
    const double end = step.at(step.length()).velocity;
    velocity_square_at_most = std::fmax(velocity_square_at_most, end * end);
  }
};

struct Ran {
  State<double> state;
  Passed account;
  Error error = Error::none;
  Cost cost;
};

/// Whole periods with drive amplitude 1.
template <class Method>
Ran run(const Contact& model, double tolerance, int periods, double sliding_velocity,
        const State<double>& from, std::uint32_t step_limit = max_steps_per_advance) {
  Method solver;
  solver.configure(model, tolerance, step_limit);
  Ran result;
  result.state = from;
  result.error = run_periods(solver, periods, 1.0, sliding_velocity, result.state, result.account);
  result.cost = solver.cost();
  return result;
}

double distance(const Ran& a, const Ran& b, int periods) {
  return std::abs(a.state.displacement - b.state.displacement) +
         std::abs(a.state.velocity - b.state.velocity) +
         std::abs(a.state.friction - b.state.friction) +
         std::abs(a.account.friction_integral - b.account.friction_integral) / (period * periods);
}

/// Friction too weak for its energy to show what its mean is; the contact turns twice in a step,
/// and reaches its limit both ways in between.
TEST(Strang, TheMeanFrictionOfAStiffContactThatTurnsTwiceInAStep) {
  const Contact grazing =
      Case().contact_stiffness(2.35e4).friction_force(2.88e-5).damping(1.08e-3).stiffness(0.726);
  const State<double> slipping = {0.0, 0.0, -0.646};
  constexpr double tolerance = 1e-4;
  const Ran exact = run<Taylor>(grazing, 1e-13, 3, 1.89, slipping);
  const Ran found = run<Solver>(grazing, tolerance, 3, 1.89, slipping);
  EXPECT_EQ(found.error, Error::none);
  EXPECT_GE(found.cost.steps, 36U);  // 12 of the longest in each period
  EXPECT_LT(found.cost.steps, 50U);
  EXPECT_NEAR(found.account.friction_integral, exact.account.friction_integral,
              period * 3 * 10.0 * tolerance);
}

/// Whatever the contact: declined, or balanced as promised, and with the friction ratio of another
/// method.
struct Checked {
  int balances = 0;
  int ratios = 0;
};

void declines_or_is_right(Checked& checked) {
  const auto decades = [](int low, int high) {
    return std::pow(10.0, 1e-3 * *rc::gen::inRange(1000 * low, 1000 * high + 1));
  };
  const auto part = [] { return 1e-3 * *rc::gen::inRange(-1000, 1001); };
  const Contact model = Case()
                            .contact_stiffness(decades(-3, 8))
                            .friction_force(decades(-8, 1))
                            .vibration_sign(*rc::gen::element(1.0, -1.0))
                            .damping(*rc::gen::element(0.0, decades(-3, 1)))
                            .stiffness(*rc::gen::element(0.0, decades(-3, 3)));
  const State<double> from = {0.0, 0.0, part()};
  const double sliding = 2.0 * part();
  constexpr double tolerance = 1e-4;
  constexpr int periods = 3;
  const Ran found = run<Solver>(model, tolerance, periods, sliding, from, 2000);
  if (found.error == Error::too_many_steps) {
    return;
  }
  RC_ASSERT(found.error == Error::none);
  RC_ASSERT(std::abs(found.state.friction) <= 1.0);
  const Passed& account = found.account;
  const double missing = account.balance_residual(model, from, found.state) *
                         account.largest_term(model, from, found.state);
  const double passed = std::fmax(
      std::fmax(account.drive, account.damper),
      std::fmax(model.contact_force(account.contact), 0.5 * account.velocity_square_at_most));
  RC_ASSERT(std::abs(missing) <= (periods + 3) * tolerance * passed);
  ++checked.balances;
  const Ran exact = run<Taylor>(model, 1e-12, periods, sliding, from, 20000);
  if (exact.error == Error::none) {
    RC_ASSERT(std::abs(account.friction_integral - exact.account.friction_integral) <
              period * periods * 20.0 * tolerance);
    ++checked.ratios;
  }
}

TEST(Strang, DeclinesOrIsRight) {
  Checked checked;
  EXPECT_TRUE(rc::check([&checked] { declines_or_is_right(checked); }));
  EXPECT_GE(checked.balances, 20);
  EXPECT_GE(checked.ratios, 20);
}

/// A step far too long for the ringing of a stuck contact.
TEST(Strang, CutsAStepThatIsTooLongForTheContact) {
  const Contact ringing = Case().contact_stiffness(1e4).friction_force(0.5);
  const State<double> displaced = {1e-11, 0.0, 1e-7};
  const double duration = 200.0 * pi / std::sqrt(0.5e4);
  auto solver = configured<Solver>(ringing, 1e-3);
  auto reference = configured<Taylor>(ringing, 1e-13);
  const Interval<double> undriven = lasting(duration);
  const State<double> exact = advanced(reference, undriven, displaced);
  const State<double> found = advanced(solver, undriven, displaced);
  EXPECT_NEAR(found.displacement, exact.displacement, 2e-13);
  EXPECT_GE(solver.cost().steps, 12288U);  // 12 of the longest, halved ten times
  EXPECT_LE(solver.cost().steps, 12320U);
}

/// 3 g on 30e6 N/m with 4 N s/m, a contact of 20e3 N/m and 0.2 N that slides at 0.4 m/s, at 20 kHz:
/// friction alone sets the mass in motion. The first step begins at rest, however short it is.
TEST(Strang, TakesTheStepsOfSecondOrderWhereFrictionAloneDrives) {
  const Contact dragged =
      Case().contact_stiffness(0.1).friction_force(4.222e-3).damping(0.01061).stiffness(0.6333);
  constexpr int periods = 5;
  constexpr double sliding = 3.1831;
  for (const double drive : {0.0, 1e-9}) {
    auto reference = configured<Taylor>(dragged, 1e-12);
    Ran exact;
    ASSERT_EQ(run_periods(reference, periods, drive, sliding, exact.state, exact.account),
              Error::none);
    std::uint64_t before = 1000;
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      auto solver = configured<Solver>(dragged, tolerance);
      Ran found;
      ASSERT_EQ(run_periods(solver, periods, drive, sliding, found.state, found.account),
                Error::none)
          << tolerance;
      // A hundredth of the tolerance takes ten times the steps.
      EXPECT_LT(solver.cost().steps, 15 * before) << tolerance;
      before = solver.cost().steps;
      EXPECT_LT(distance(found, exact, periods), 20.0 * tolerance * dragged.friction_force)
          << tolerance;
    }
  }
}

/// A contact that is loaded against the sliding, and slips to its limit within 1e-4 of a period.
TEST(Strang, WhatIsHardAtTheBeginningDoesNotCutTheRest) {
  const Contact loaded =
      Case().contact_stiffness(2e3).friction_force(0.05).damping(0.01).stiffness(0.05);
  const State<double> against = {0.0, 0.0, -0.9};
  const Ran exact = run<Taylor>(loaded, 1e-12, 1, 2.0, against);
  const Ran found = run<Solver>(loaded, 1e-6, 1, 2.0, against, 2000);
  ASSERT_EQ(found.error, Error::none);
  EXPECT_LT(distance(found, exact, 1), 1e-5);
}

/// A vibration of 1 that the damper stops, and then one of 1e-6, which turns the sliding.
TEST(Strang, WhatHasDiedAwayIsNoMeasure) {
  const Contact damped =
      Case().contact_stiffness(1e7).friction_force(1e-9).damping(40.0).stiffness(3000.0);
  const State<double> displaced = {0.02, 0.0, 0.0};
  const auto ratio = [&](auto solver) {
    State<double> state = displaced;
    EnergyAccount<double> account;
    EXPECT_EQ(run_periods(solver, 3, 3e-3, 3e-7, state, account), Error::none);
    return account.friction_integral / (3.0 * period);
  };
  EXPECT_NEAR(ratio(configured<Solver>(damped, 1e-6)), ratio(configured<Taylor>(damped, 1e-12)),
              1e-4);
}

/// Friction as printed pushes the sliding on: a kick must not turn it.
TEST(Strang, AKickThatTurnsTheSlidingIsNoStep) {
  const Contact pumped =
      Case().contact_stiffness(1e5).friction_force(1.0).vibration_sign(-1.0).stiffness(1e-3);
  const State<double> against = {0.0, 0.0, -1.0};
  const Ran exact = run<Taylor>(pumped, 1e-12, 1, 0.02, against);
  const Ran found = run<Solver>(pumped, 1e-4, 1, 0.02, against);
  EXPECT_NEAR(found.account.friction_integral, exact.account.friction_integral, 1e-3);
  EXPECT_GT(found.account.friction_integral, 6.0);
}

TEST(Strang, DeclinesWhatItsStepsDoNotReach) {
  const Contact stiff = Case().contact_stiffness(1e8).friction_force(0.5).stiffness(0.05);
  Solver solver;
  solver.configure(stiff, 1e-6, 1000);
  State<double> state;
  NoAccount account;
  const Outcome<double> outcome =
      advance(solver, lasting(period).driven(1.0).sliding(0.5), state, account);
  EXPECT_EQ(outcome.error, Error::too_many_steps);
  EXPECT_LT(outcome.offset, period);
  EXPECT_GE(solver.cost().steps, 1U);
  EXPECT_LE(solver.cost().steps, 1000U);
}

TEST(Strang, DeclinesAToleranceBelowRounding) {
  EXPECT_EQ(run<Solver>(ordinary, 1e-18, 1, 0.3, start, 5000).error, Error::too_many_steps);
}

TEST(Strang, TellsOfAStateThatIsNoNumber) {
  const Ran lost = run<Solver>(ordinary, 1e-4, 1, 0.3, {std::nan(""), 0.0, 0.0}, 1000);
  EXPECT_NE(lost.error, Error::none);
}

TEST(Strang, OfASteadyMotionEveryPeriodTakesTheSameSteps) {
  auto solver = configured<Solver>(ordinary, 1e-5);
  State<double> state = start;
  NoAccount account;
  ASSERT_EQ(run_periods(solver, 20, 1.0, 0.3, state, account), Error::none);
  const std::uint64_t settled = solver.cost().steps;
  ASSERT_EQ(run_periods(solver, 1, 1.0, 0.3, state, account), Error::none);
  const std::uint64_t one = solver.cost().steps - settled;
  ASSERT_EQ(run_periods(solver, 50, 1.0, 0.3, state, account), Error::none);
  EXPECT_EQ(solver.cost().steps, settled + 51 * one);
}

/// A contact that rings, and then slides to and fro as if it never had.
TEST(Strang, ItsStepsGrowAgainWhereTheyMay) {
  const Contact model =
      Case().contact_stiffness(1e3).friction_force(1e-3).damping(0.2).stiffness(0.6);
  const auto steps_of_a_late_period = [&](double first_drive) {
    auto solver = configured<Solver>(model, 1e-4);
    State<double> state;
    NoAccount account;
    EXPECT_EQ(run_periods(solver, 2, first_drive, 0.0, state, account), Error::none);
    EXPECT_EQ(run_periods(solver, 20, 1.0, 0.3, state, account), Error::none);
    const std::uint64_t before = solver.cost().steps;
    EXPECT_EQ(run_periods(solver, 1, 1.0, 0.3, state, account), Error::none);
    return solver.cost().steps - before;
  };
  const std::uint64_t after_ringing = steps_of_a_late_period(1e-9);
  const std::uint64_t unrung = steps_of_a_late_period(1.0);
  EXPECT_GE(2 * after_ringing, unrung);
  EXPECT_LE(after_ringing, 2 * unrung);
}

TEST(Strang, NoStepIsLongerThanTheLongest) {
  Solver solver;
  solver.configure(ordinary, 1e-2, max_steps_per_advance, period / 500.0);
  State<double> state = start;
  NoAccount account;
  double longest = 0.0;
  auto watch = [&](const auto& step) { longest = std::fmax(longest, step.length()); };
  ASSERT_EQ(solver.advance(lasting(period).driven(1.0).sliding(0.3), state, account, watch).error,
            Error::none);
  EXPECT_NEAR(longest, period / 500.0, 1e-12);
}

}  // namespace
}  // namespace sonoglide::plant::strang_test
