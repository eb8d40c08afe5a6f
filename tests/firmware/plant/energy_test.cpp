/// The energy identity and the friction bound, over many decades of every parameter.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::energy_test {
namespace {

/// The same sequence of cases on every machine.
class Cases {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11U), -53);
  }
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  double or_zero(double x) { return uniform(0.0, 1.0) < 0.2 ? 0.0 : x; }
  double sign() { return uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0; }

 private:
  std::mt19937_64 engine_;
};

template <class Law>
Model<Law, Damped<double>, CosineDrive> any_model(Cases& any, const Law& law) {
  return {{law, any.or_zero(any.decades(-8.0, 0.5)), any.sign()},
          {any.or_zero(any.decades(-3.0, 1.0))},
          any.or_zero(any.decades(-3.0, 1.5))};
}

Interval<double> any_interval(Cases& any) {
  const double phase = any.uniform(0.0, 6.28);
  return lasting(any.uniform(0.5, 13.0))
      .from_phase(phase)
      .driven(any.or_zero(any.uniform(0.1, 2.0)))
      .sliding(any.or_zero(any.uniform(-1.5, 1.5)))
      .accelerating(any.or_zero(any.uniform(-0.2, 0.2)));
}

State<double> any_state(Cases& any) {
  return {any.or_zero(any.uniform(-1.0, 1.0)), any.or_zero(any.uniform(-1.0, 1.0)),
          any.or_zero(any.uniform(-1.0, 1.0))};
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
void expect_bound_and_balance(Cases& any, const Law& law, double tolerance, double residual) {
  const auto model = any_model(any, law);
  const Interval<double> interval = any_interval(any);
  const State<double> before = any_state(any);
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
  Cases any;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    expect_bound_and_balance<16>(any, friction::Dahl<double>{any.decades(-6.0, 5.0)}, 1e-15, 1e-12);
  }
}

TEST(AnyPlant, DahlKeepsTheBoundHoweverLooseTheTolerance) {
  Cases any;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    expect_bound_and_balance<8>(any, friction::Dahl<double>{any.decades(-6.0, 7.0)}, 1e-2, 1e9);
  }
}

TEST(AnyPlant, CoulombKeepsBoundAndBalance) {
  Cases any;
  for (int i = 0; i < 5000; ++i) {
    SCOPED_TRACE(i);
    expect_bound_and_balance<16>(any, friction::Coulomb<double>{}, 1e-15, 1e-12);
  }
}

TEST(AnyPlant, SplittingAnIntervalChangesNothingBeyondTheTolerance) {
  using Contact = Model<friction::Dahl<double>, Damped<double>, CosineDrive>;
  Cases any;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    Contact model = any_model(any, friction::Dahl<double>{any.decades(-3.0, 2.0)});
    model.vibration_sign = 1.0;
    const Interval<double> whole = any_interval(any);
    const State<double> before = any_state(any);
    auto solver = configured<EventTaylor<Contact, 16>>(model, 1e-14);
    Interval<double> first = whole;
    first.duration = any.uniform(0.0, 1.0) * whole.duration;
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

TEST(EnergyAccount, OfRk4BalancesToItsOrder) {
  const DampedDahlModel<double> model =
      Case().contact_stiffness(0.5).friction_force(0.3).vibration_sign(-1.0).damping(0.1).stiffness(
          0.4);
  auto solver = configured<Rk4<DampedDahlModel<double>>>(model, 1e-3);
  const State<double> before = {0.3, 0.0, 0.0};
  State<double> state = before;
  EnergyAccount<double> account;
  EXPECT_EQ(
      advance(solver, lasting(20.0).driven(1.0).sliding(0.4).accelerating(0.01), state, account)
          .error,
      Error::none);
  EXPECT_NEAR(account.balance_residual(model, before, state), 0.0, 1e-9);
}

TEST(EnergyAccount, OfNothingHasNoResidual) {
  const DahlModel<double> model = Case().contact_stiffness(1.0).friction_force(1.0).stiffness(1.0);
  EXPECT_EQ(EnergyAccount<double>().balance_residual(model, {}, {}), 0.0);
}

}  // namespace
}  // namespace sonoglide::plant::energy_test
