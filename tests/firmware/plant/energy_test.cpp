/// The energy identity and the friction bound, over many decades of every parameter.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/common/dice/dice.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::energy_test {
namespace {

using tests::Dice;

constexpr std::uint64_t seed = 5489;

double or_zero(Dice& dice, double x) {
  return dice.chance(0.2) ? 0.0 : x;
}

template <class Law>
Model<Law, Damped<double>, CosineDrive> any_model(Dice& dice, const Law& law) {
  return {{law, or_zero(dice, dice.decades(1e-8, 3.2)), dice.sign()},
          {or_zero(dice, dice.decades(1e-3, 10.0))},
          or_zero(dice, dice.decades(1e-3, 32.0))};
}

Interval<double> any_interval(Dice& dice) {
  const double phase = dice.between(0.0, 6.28);
  return lasting(dice.between(0.5, 13.0))
      .from_phase(phase)
      .driven(or_zero(dice, dice.between(0.1, 2.0)))
      .sliding(or_zero(dice, dice.between(-1.5, 1.5)))
      .accelerating(or_zero(dice, dice.between(-0.2, 0.2)));
}

State<double> any_state(Dice& dice) {
  return {or_zero(dice, dice.between(-1.0, 1.0)), or_zero(dice, dice.between(-1.0, 1.0)),
          or_zero(dice, dice.between(-1.0, 1.0))};
}

/// The largest |phi| and the most stored energy seen inside the steps.
template <class Contact>
struct Extremes {
  const Contact& model;
  double friction = 0.0;
  double stored_energy = 0.0;

  template <class Step>
  void operator()(const Step& step) {
    for (const double part : {0.0, 0.3, 0.7, 1.0}) {
      const State<double> state = step.at(part * step.length());
      friction = std::fmax(friction, std::abs(state.friction));
      stored_energy = std::fmax(stored_energy, model.stored_energy(state));
    }
  }
};

template <std::size_t Order, class Law>
void expect_bound_and_balance(Dice& dice, const Law& law, double tolerance, double residual) {
  const auto model = any_model(dice, law);
  const Interval<double> interval = any_interval(dice);
  const State<double> before = any_state(dice);
  auto solver =
      configured<EventTaylor<Model<Law, Damped<double>, CosineDrive>, Order>>(model, tolerance);
  State<double> state = before;
  EnergyAccount<double> account;
  Extremes<decltype(model)> extremes{model};
  const Outcome<double> outcome = solver.advance(interval, state, account, extremes);
  EXPECT_EQ(outcome.error, Error::none);
  EXPECT_EQ(outcome.offset, interval.duration);
  EXPECT_LE(extremes.friction, 1.0);
  // The energy that came and went is the scale where the net terms are smaller than it.
  const double largest = account.largest_term(model, before, state);
  const double scale = std::fmax(1.0, extremes.stored_energy / largest);
  EXPECT_LE(std::abs(account.balance_residual(model, before, state)), residual * scale);
}

TEST(AnyPlant, DahlKeepsBoundAndBalance) {
  Dice dice(seed);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    expect_bound_and_balance<16>(dice, friction::Dahl<double>{dice.decades(1e-6, 1e5)}, 1e-15,
                                 1e-12);
  }
}

TEST(AnyPlant, DahlKeepsTheBoundHoweverLooseTheTolerance) {
  Dice dice(seed);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    expect_bound_and_balance<8>(dice, friction::Dahl<double>{dice.decades(1e-6, 1e7)}, 1e-2, 1e9);
  }
}

TEST(AnyPlant, CoulombKeepsBoundAndBalance) {
  Dice dice(seed);
  for (int i = 0; i < 5000; ++i) {
    SCOPED_TRACE(i);
    expect_bound_and_balance<16>(dice, friction::Coulomb<double>{}, 1e-15, 1e-12);
  }
}

TEST(AnyPlant, SplittingAnIntervalChangesNothingBeyondTheTolerance) {
  using Contact = Model<friction::Dahl<double>, Damped<double>, CosineDrive>;
  Dice dice(seed);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    Contact model = any_model(dice, friction::Dahl<double>{dice.decades(1e-3, 1e2)});
    model.vibration_sign = 1.0;
    const Interval<double> whole = any_interval(dice);
    const State<double> before = any_state(dice);
    auto solver = configured<EventTaylor<Contact, 16>>(model, 1e-14);
    Interval<double> first = whole;
    first.duration = dice.between(0.0, 1.0) * whole.duration;
    Interval<double> second = whole;
    second.phase_begin += first.duration;
    second.duration -= first.duration;
    second.sliding_velocity += whole.sliding_acceleration * first.duration;
    const State<double> at_once = advanced(solver, whole, before);
    const State<double> in_two = advanced(solver, second, advanced(solver, first, before));
    EXPECT_NEAR(at_once.displacement, in_two.displacement, 1e-11);
    EXPECT_NEAR(at_once.velocity, in_two.velocity, 1e-11);
    EXPECT_NEAR(at_once.friction, in_two.friction, 1e-9);
  }
}

TEST(EnergyAccount, BalancesOverManyPeriodsOfTable1) {
  constexpr tests::DimensionlessTable1 table_1(384.0);
  const DahlModel<double> model = Case()
                                      .contact_stiffness(table_1.contact_stiffness)
                                      .friction_force(table_1.friction_force)
                                      .stiffness(table_1.stiffness);
  const double sliding = 0.5 * table_1.vibration;
  auto solver = configured<EventTaylor<DahlModel<double>, 16>>(model, 1e-15);
  const State<double> before;
  State<double> state = before;
  EnergyAccount<double> account;
  EXPECT_EQ(run_periods(solver, 1000, 1.0, sliding, state, account), Error::none);
  EXPECT_NEAR(account.balance_residual(model, before, state), 0.0, 1e-12);
  EXPECT_NEAR(account.sliding_work, sliding * account.friction_integral, 1e-10);
}

TEST(EnergyAccount, OfNothingHasNoResidual) {
  const DahlModel<double> model = Case().contact_stiffness(1.0).friction_force(1.0).stiffness(1.0);
  EXPECT_EQ(EnergyAccount<double>().balance_residual(model, {}, {}), 0.0);
}

}  // namespace
}  // namespace sonoglide::plant::energy_test
