/// Steps in closed form against the Taylor method, which knows nothing of them, and against phasors;
/// what turns against Boost.odeint.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <vector>

#include "firmware/friction/coulomb.hpp"
#include "firmware/friction/dahl.hpp"
#include "firmware/friction/iwan.hpp"
#include "firmware/friction/none.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/stiff/stiff_linear.hpp"
#include "firmware/plant/strang/strang.hpp"
#include "firmware/plant/taylor/event_taylor.hpp"
#include "firmware/plant/velocity_quadrature.hpp"

namespace sonoglide::plant::stiff_linear_test {
namespace {

template <class Law, class Drive = CosineDrive>
using ModelOf = Model<Law, Damped<double>, Drive>;
template <class Model>
using Taylor = EventTaylor<Model, 16>;
template <class Model>
using Stiff = StiffLinear<Taylor<Model>>;

constexpr double period = numeric::two_pi;

/// What two solvers have in common after some periods.
struct Record {
  State<double> state;
  EnergyAccount<double> account;
  double in_phase = 0.0;
  double quadrature = 0.0;
  std::uint64_t steps = 0;
};

template <class Solver>
Record run(const typename Solver::Model& model,
           const std::vector<IntervalOf<typename Solver::Model>>& intervals,
           const State<double>& from) {
  Solver solver;
  solver.configure(model, 1e-13);
  StateOf<typename Solver::Model::FrictionLaw> state;
  static_cast<State<double>&>(state) = from;
  if constexpr (Solver::Model::FrictionLaw::remembers) {
    state.memory = model.law.memory_at(from.friction);
  }
  Record record;
  for (const auto& interval : intervals) {
    Demodulator<double> demodulator(interval.phase_begin);
    EXPECT_EQ(solver.advance(interval, state, record.account, demodulator).error, Error::none);
    record.in_phase += demodulator.in_phase();
    record.quadrature += demodulator.quadrature();
  }
  record.state = state;
  record.steps = solver.cost().steps;
  return record;
}

std::vector<Interval<double>> periods(int count, double amplitude, double sliding) {
  return std::vector<Interval<double>>(static_cast<std::size_t>(count),
                                       {0.0, period, amplitude, sliding, 0.0});
}

/// Relative to the size of the motion, and of the energy that passed.
void expect_same(const Record& exact, const Record& series, double stiffness, double tolerance) {
  const EnergyAccount<double>& a = exact.account;
  const EnergyAccount<double>& b = series.account;
  const double size = std::sqrt(b.displacement_square);
  const double speed = std::sqrt(b.velocity_square);
  const double energy = stiffness * b.displacement_square + b.velocity_square;
  EXPECT_NEAR(exact.state.displacement, series.state.displacement, tolerance * size);
  EXPECT_NEAR(exact.state.velocity, series.state.velocity, tolerance * speed);
  EXPECT_NEAR(exact.state.friction, series.state.friction, tolerance);
  EXPECT_NEAR(a.friction_integral, b.friction_integral, tolerance);
  EXPECT_NEAR(a.friction_work, b.friction_work, tolerance * (1.0 + std::abs(b.friction_work)));
  EXPECT_NEAR(a.sliding_work, b.sliding_work, tolerance * (1.0 + std::abs(b.sliding_work)));
  EXPECT_NEAR(a.drive_work, b.drive_work, tolerance * energy);
  EXPECT_NEAR(a.damping_work, b.damping_work, tolerance * energy);
  EXPECT_NEAR(a.velocity_square, b.velocity_square, tolerance * b.velocity_square);
  EXPECT_NEAR(a.displacement_square, b.displacement_square, tolerance * b.displacement_square);
  EXPECT_NEAR(exact.in_phase, series.in_phase, tolerance * speed);
  EXPECT_NEAR(exact.quadrature, series.quadrature, tolerance * speed);
}

constexpr double stiffness = 6e4;

/// Undamped, weakly, critically, almost critically and overdamped.
std::vector<double> dampings() {
  const double critical = 2.0 * std::sqrt(stiffness);
  return {
      0.0,           1e-3, 3.0, 0.7 * critical, 0.999999 * critical, critical, 1.000001 * critical,
      9.0 * critical};
}

TEST(StiffLinear, IsASolver) {
  EXPECT_TRUE(check_solver<Stiff<ModelOf<friction::Dahl<double>>>>());
}

TEST(StiffLinear, WithoutFrictionAgreesWithTaylor) {
  using Plant = ModelOf<friction::None<double>>;
  for (const double damping : dampings()) {
    SCOPED_TRACE(damping);
    const Plant model = {{}, {damping}, stiffness};
    std::vector<Interval<double>> intervals = periods(3, 2e4, 0.3);
    intervals[1].phase_begin = 1.3;
    const State<double> from = {0.4, -20.0, 0.0};
    const Record exact = run<Stiff<Plant>>(model, intervals, from);
    EXPECT_EQ(exact.steps, 3U);
    expect_same(exact, run<Taylor<Plant>>(model, intervals, from), stiffness, 2e-10);
  }
}

TEST(StiffLinear, DrivesOfStraightPiecesAgreeWithTaylor) {
  using Free = ModelOf<friction::None<double>, StraightDrive>;
  using Rubbing = ModelOf<friction::Coulomb<double>, StraightDrive>;
  for (const double damping : dampings()) {
    SCOPED_TRACE(damping);
    const std::vector<IntervalOf<Free>> ramps = {{-0.5 * period, period, {0.0, 1e4}, 9e3, 0.0},
                                                 {-0.5 * period, period, {0.0, -1e4}, 9e3, 0.0}};
    const Free free = {{}, {damping}, stiffness};
    expect_same(run<Stiff<Free>>(free, ramps, {}), run<Taylor<Free>>(free, ramps, {}), stiffness,
                2e-10);
    const std::vector<IntervalOf<Rubbing>> levels = {
        {-0.5 * period, period, {1e4, 0.0}, 9e3, 0.0},
        {-0.5 * period, period, {-1e4, 0.0}, 9e3, 0.0}};
    const Rubbing rubbing = {{{}, 1e4, 1.0}, {damping}, stiffness};
    expect_same(run<Stiff<Rubbing>>(rubbing, levels, {}), run<Taylor<Rubbing>>(rubbing, levels, {}),
                stiffness, 2e-10);
  }
}

/// Sliding that changes its speed but never turns.
TEST(StiffLinear, AContactThatSlidesAtItsLimitAgreesWithTaylor) {
  using Rigid = ModelOf<friction::Coulomb<double>>;
  using Elastic = ModelOf<friction::Dahl<double>>;
  using Layered = ModelOf<friction::Iwan<double>>;
  std::vector<Interval<double>> intervals = periods(3, 3e4, -900.0);
  intervals[1].sliding_acceleration = 50.0;
  for (const double side : {1.0, -1.0}) {
    for (const double damping : {0.0, 2.0, 1e3}) {
      SCOPED_TRACE(damping);
      const Rigid rigid = {{{}, 2e4, side}, {damping}, stiffness};
      const Record exact = run<Stiff<Rigid>>(rigid, intervals, {});
      EXPECT_EQ(exact.steps, 3U);
      expect_same(exact, run<Taylor<Rigid>>(rigid, intervals, {}), stiffness, 5e-10);
      // These are not at their limit at first: the Taylor method takes them there.
      const Elastic elastic = {{{0.3}, 2e4, side}, {damping}, stiffness};
      const Record settled = run<Stiff<Elastic>>(elastic, intervals, {0.0, 0.0, 0.5});
      EXPECT_LT(settled.steps, 700U);
      expect_same(settled, run<Taylor<Elastic>>(elastic, intervals, {0.0, 0.0, 0.5}), stiffness,
                  2e-9);
      const Layered layered = {{{0.3, 4}, 2e4, side}, {damping}, stiffness};
      expect_same(run<Stiff<Layered>>(layered, intervals, {}),
                  run<Taylor<Layered>>(layered, intervals, {}), stiffness, 2e-9);
    }
  }
}

/// A contact so soft that its force holds, though its sliding turns.
TEST(StiffLinear, AContactThatHardlyMovesAgreesWithTaylor) {
  using Elastic = ModelOf<friction::Dahl<double>>;
  const Elastic elastic = {{{1e-20}, 2e4, 1.0}, {0.1}, stiffness};
  const State<double> from = {0.0, 0.0, 0.6};
  const Record exact = run<Stiff<Elastic>>(elastic, periods(3, 3e4, 0.01), from);
  EXPECT_EQ(exact.steps, 3U);
  expect_same(exact, run<Taylor<Elastic>>(elastic, periods(3, 3e4, 0.01), from), stiffness, 2e-10);
}

/// y, v, phi and the integral of phi, by the Runge-Kutta formula of order 8 from reversal to reversal
/// of V: the force is smooth between them.
std::array<double, 4> by_a_peer(const ModelOf<friction::Dahl<double>>& model,
                                const Interval<double>& interval, const State<double>& from) {
  using Numbers = std::array<double, 4>;
  namespace odeint = boost::numeric::odeint;
  double direction = 1.0;
  const auto velocity = [&](const Numbers& at) {
    return interval.sliding_velocity + model.vibration_sign * at[1];
  };
  const auto slope = [&](const Numbers& at, Numbers& rate, double time) {
    rate = {at[1],
            interval.drive_amplitude * std::cos(time) - model.damping * at[1] -
                model.stiffness * at[0] - model.friction_force * at[2],
            model.law.contact_stiffness * velocity(at) * (1.0 - direction * at[2]), at[2]};
  };
  const auto formula =
      odeint::make_controlled(1e-15, 1e-13, odeint::runge_kutta_fehlberg78<Numbers>());
  const auto moved = [&](Numbers at, double time, double length) {
    odeint::integrate_adaptive(formula, slope, at, time, time + length, 0.1 * length);
    return at;
  };
  const double longest =
      0.2 / std::sqrt(model.stiffness + model.friction_force * model.law.contact_stiffness);
  Numbers now = {from.displacement, from.velocity, from.friction, 0.0};
  direction = velocity(now) < 0.0 ? -1.0 : 1.0;
  for (double time = 0.0; time < interval.duration;) {
    double length = std::min(longest, interval.duration - time);
    const bool last = length < longest;
    Numbers next = moved(now, time, length);
    if (direction * velocity(next) < 0.0) {
      double low = 0.0;
      for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + length);
        (direction * velocity(moved(now, time, middle)) < 0.0 ? length : low) = middle;
      }
      next = moved(now, time, length);
      direction = -direction;
    } else if (last) {
      length = interval.duration;
    }
    now = next;
    time += length;
  }
  return now;
}

/// Whichever solver is asked for, order 16 takes what turns.
TEST(StiffLinear, AContactThatTurnsWithTheModeAgreesWithAPeer) {
  using Elastic = ModelOf<friction::Dahl<double>>;
  using High = Taylor<Elastic>;
  const Interval<double> interval = {0.0, 0.9, 3e4, 5.0, 0.0};
  for (const double side : {1.0, -1.0}) {
    // As soft as its own mode, or so stiff that it is at its limit in a hundredth of a turn.
    for (const double contact : {0.5, 1e3}) {
      SCOPED_TRACE(contact);
      const Elastic model = {{{contact}, 2e3, side}, {0.1}, stiffness};
      const State<double> from = {0.4, 0.0, 0.3};
      const Record taylor =
          run<StiffLinear<EventTaylor<Elastic, 8>, High>>(model, {interval}, from);
      const std::array<double, 4> peer = by_a_peer(model, interval, from);
      EXPECT_NEAR(taylor.state.displacement, peer[0], 1e-9);
      EXPECT_NEAR(taylor.state.velocity, peer[1], 1e-9 * std::sqrt(stiffness));
      EXPECT_NEAR(taylor.state.friction, peer[2], 1e-8);
      EXPECT_NEAR(taylor.account.friction_integral, peer[3], 1e-10);
      const Record strang = run<StiffLinear<Strang<Elastic>, High>>(model, {interval}, from);
      const Record high = run<Stiff<Elastic>>(model, {interval}, from);
      for (const Record& record : {taylor, strang}) {
        EXPECT_EQ(record.state.displacement, high.state.displacement);
        EXPECT_EQ(record.account.friction_integral, high.account.friction_integral);
        EXPECT_EQ(record.steps, high.steps);
      }
    }
  }
}

/// The mode is slow; a contact that sticks turns.
TEST(StiffLinear, AStuckContactThatTurnsAgreesWithAPeer) {
  using Elastic = ModelOf<friction::Dahl<double>>;
  const Elastic model = {{{1e4}, 10.0, 1.0}, {0.0}, 1.0};
  const Interval<double> interval = {0.0, 1.0, 3.0, 1e-3, 0.0};
  const Record turning =
      run<StiffLinear<EventTaylor<Elastic, 8>, Taylor<Elastic>>>(model, {interval}, {});
  const std::array<double, 4> peer = by_a_peer(model, interval, {});
  EXPECT_NEAR(turning.state.friction, peer[2], 1e-9);
  EXPECT_NEAR(turning.account.friction_integral, peer[3], 1e-9);
  EXPECT_EQ(turning.steps, run<Taylor<Elastic>>(model, {interval}, {}).steps);
}

TEST(StiffLinear, WhatTurnsSlowlyIsLeftToTheSolverBitForBit) {
  using Rigid = ModelOf<friction::Coulomb<double>>;
  const Rigid soft = {{{}, 0.2, 1.0}, {0.01}, 0.5};
  const auto intervals = periods(5, 1.0, 0.3);
  const Record left = run<Stiff<Rigid>>(soft, intervals, {});
  const Record solver = run<Taylor<Rigid>>(soft, intervals, {});
  EXPECT_EQ(left.state.displacement, solver.state.displacement);
  EXPECT_EQ(left.state.velocity, solver.state.velocity);
  EXPECT_EQ(left.account.friction_integral, solver.account.friction_integral);
  EXPECT_EQ(left.steps, solver.steps);
}

/// From rest under a cosine, without damping: y = a (cos t - cos(w t)) / (k - 1).
TEST(StiffLinear, AnyRatioOfFrequenciesIsThatOfThePhasors) {
  using Plant = ModelOf<friction::None<double>>;
  for (const double mode : {1e3, 1e5, 1e7}) {
    const double k = mode * mode + 0.37;
    const Record end = run<Stiff<Plant>>({{}, {0.0}, k}, {{0.0, 5.0, k, 0.0, 0.0}}, {});
    const auto exact_k = static_cast<long double>(k);
    const long double w = std::sqrt(exact_k);
    const long double amplitude = exact_k / (exact_k - 1.0L);
    const double tolerance = 1e-15 * mode + 1e-14;
    EXPECT_NEAR(end.state.displacement,
                static_cast<double>(amplitude * (std::cos(5.0L) - std::cos(w * 5.0L))),
                8.0 * tolerance);
    EXPECT_NEAR(end.state.velocity / mode,
                static_cast<double>(amplitude * (w * std::sin(w * 5.0L) - std::sin(5.0L)) /
                                    static_cast<long double>(mode)),
                8.0 * tolerance);
  }
}

TEST(StiffLinear, APhaseThatIsLostIsDeclined) {
  using Plant = ModelOf<friction::None<double>>;
  Stiff<Plant> solver;
  solver.configure({{}, {0.0}, 1e24}, 1e-10, 1000);
  State<double> state = {1.0, 0.0, 0.0};
  NoAccount account;
  NoObserver observer;
  EXPECT_EQ(solver.advance({0.0, period, 1.0, 0.0, 0.0}, state, account, observer).error,
            Error::too_many_steps);
}

}  // namespace
}  // namespace sonoglide::plant::stiff_linear_test
