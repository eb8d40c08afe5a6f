/// What every solver has to do alike: closed forms, reversals, degenerate plants, the bound and the
/// balance.

#include "solver_suite.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>

namespace sonoglide::plant::solver_suite_test {
namespace {

template <class Method>
class OscillatorSuite : public testing::Test {
 protected:
  static Advanced frictionless(const Case& c, const Course& course,
                               const State<double>& start = {}) {
    const Advanced run = run_of<Method, DampedFrictionless>(c, course, start);
    EXPECT_EQ(run.error, Error::none);
    EXPECT_EQ(run.state.friction, 0.0);
    EXPECT_EQ(run.account.friction_work, 0.0);
    EXPECT_NEAR(run.balance_residual, 0.0, Method::smooth);
    return run;
  }
};
TYPED_TEST_SUITE(OscillatorSuite, OscillatorMethods, SolverMethodName);

template <class Method>
class SolverSuite : public testing::Test {
 protected:
  static Advanced dahl(const Case& c, const Course& course, const State<double>& start = {}) {
    const Advanced run = run_of<Method>(c, course, start);
    EXPECT_EQ(run.error, Error::none);
    EXPECT_NEAR(run.balance_residual, 0.0, Method::smooth);
    return run;
  }
};
TYPED_TEST_SUITE(SolverSuite, SolverMethods, SolverMethodName);

constexpr double duration = 7.0;

// The oscillator alone.

template <class Scalar>
using FreeOscillator = Model<friction::None<Scalar>, Undamped<Scalar>, NoDrive>;
static_assert(sizeof(FreeOscillator<double>) == sizeof(double),
              "only the stiffness is a parameter");

/// A plant without what does not act has the same bits.
TYPED_TEST(OscillatorSuite, FreeOscillation) {
  const double k = 0.37;
  const double w = std::sqrt(k);
  const Case c = Case().stiffness(k);
  const State<double> start = {0.7, -0.4, 0.0};
  const State<double> state = this->frictionless(c, lasting(duration), start).state;
  expect_near(state,
              {0.7 * std::cos(w * duration) - 0.4 / w * std::sin(w * duration),
               -0.7 * w * std::sin(w * duration) - 0.4 * std::cos(w * duration), 0.0},
              TypeParam::smooth);
  expect_near(run_of<TypeParam, FreeOscillator>(c, lasting(duration), start).state, state, 0.0);
}

TYPED_TEST(OscillatorSuite, FreeFlight) {
  const Advanced run = this->frictionless(Case(), lasting(duration), {0.7, -0.4, 0.0});
  expect_near(run.state, {0.7 - 0.4 * duration, -0.4, 0.0}, TypeParam::smooth);
}

TYPED_TEST(OscillatorSuite, DrivenFromRest) {
  const double k = 0.37;
  const double w = std::sqrt(k);
  const double gain = 1.3 / (k - 1.0);
  const Advanced run = this->frictionless(Case().stiffness(k), lasting(duration).driven(1.3));
  expect_near(run.state,
              {gain * (std::cos(duration) - std::cos(w * duration)),
               gain * (-std::sin(duration) + w * std::sin(w * duration)), 0.0},
              TypeParam::smooth);
}

TYPED_TEST(OscillatorSuite, DrivenAtResonance) {
  const Advanced run = this->frictionless(Case().stiffness(1.0), lasting(20.0).driven(1.0));
  expect_near(run.state, {10.0 * std::sin(20.0), 0.5 * std::sin(20.0) + 10.0 * std::cos(20.0), 0.0},
              20.0 * TypeParam::smooth);
}

TYPED_TEST(OscillatorSuite, DrivenFreeMass) {
  const Advanced run = this->frictionless(Case(), lasting(duration).driven(1.0));
  expect_near(run.state, {1.0 - std::cos(duration), std::sin(duration), 0.0}, TypeParam::smooth);
}

TYPED_TEST(OscillatorSuite, UnstableSpring) {
  const Advanced run = this->frictionless(Case().stiffness(-0.25), lasting(4.0), {0.1, 0.0, 0.0});
  expect_near(run.state, {0.1 * std::cosh(2.0), 0.05 * std::sinh(2.0), 0.0}, TypeParam::smooth);
}

TYPED_TEST(OscillatorSuite, UnderdampedDecay) {
  const double d = 0.1;
  const double k = 1.7;
  const double w = std::sqrt(k - 0.25 * d * d);
  const double decay = std::exp(-0.5 * d * duration);
  const Advanced run =
      this->frictionless(Case().damping(d).stiffness(k), lasting(duration), {1.0, 0.0, 0.0});
  expect_near(run.state,
              {decay * (std::cos(w * duration) + 0.5 * d / w * std::sin(w * duration)),
               -decay * k / w * std::sin(w * duration), 0.0},
              TypeParam::smooth);
}

TYPED_TEST(OscillatorSuite, OverdampedDecay) {
  const double d = 12.0;
  const double k = 1.5;
  const double root = std::sqrt(d * d - 4.0 * k);
  const double slow = 2.0 * k / (-d - root);
  const double fast = 0.5 * (-d - root);
  const Advanced run =
      this->frictionless(Case().damping(d).stiffness(k), lasting(3.0), {1.0, 0.0, 0.0});
  expect_near(run.state,
              {(fast * std::exp(slow * 3.0) - slow * std::exp(fast * 3.0)) / (fast - slow),
               slow * fast * (std::exp(slow * 3.0) - std::exp(fast * 3.0)) / (fast - slow), 0.0},
              10.0 * TypeParam::smooth);
}

TYPED_TEST(OscillatorSuite, DampedSteadyOrbit) {
  const double d = 0.2;
  const std::complex<double> amplitude = 1.0 / std::complex<double>(0.1, d);
  const std::complex<double> turned = amplitude * std::polar(1.0, duration);
  const Advanced run =
      this->frictionless(Case().damping(d).stiffness(1.1), lasting(duration).driven(1.0),
                         {amplitude.real(), -amplitude.imag(), 0.0});
  expect_near(run.state, {turned.real(), -turned.imag(), 0.0}, 10.0 * TypeParam::smooth);
}

TYPED_TEST(OscillatorSuite, AmplitudeChangedAtAPeriodBoundary) {
  using Scalar = typename TypeParam::Scalar;
  using Model = DampedFrictionless<Scalar>;
  const double k = 0.37;
  const double w = std::sqrt(k);
  auto solver = configured<typename TypeParam::template Solver<Model>>(
      Model(Case().stiffness(k)), static_cast<Scalar>(TypeParam::setting));
  State<Scalar> state;
  for (const double amplitude : {1.0, 2.5, 0.0}) {
    state = advanced(solver, lasting(2.0 * pi).driven(amplitude), state);
  }
  // Each interval adds amplitude / (k - 1) (cos(tau) - cos(w tau)), which then rings freely.
  double displacement = 0.0;
  double velocity = 0.0;
  double since = 6.0 * pi;
  double before = 0.0;
  for (const double amplitude : {1.0, 2.5, 0.0}) {
    const double gain = (amplitude - before) / (k - 1.0);
    displacement += gain * (std::cos(since) - std::cos(w * since));
    velocity += gain * (-std::sin(since) + w * std::sin(w * since));
    since -= 2.0 * pi;
    before = amplitude;
  }
  expect_near(state_cast<double>(state), {displacement, velocity, 0.0}, 10.0 * TypeParam::smooth);
}

// Prescribed motion: no reaction of friction, so that Dahl's force is a closed form.

/// phi after the displacement u in one direction.
double after_travel(double friction, double contact_stiffness, double u) {
  const double direction = u < 0.0 ? -1.0 : 1.0;
  return direction *
         (1.0 - (1.0 - direction * friction) * std::exp(-contact_stiffness * std::abs(u)));
}

/// From rest V = r + sigma a sin(tau): u = r tau + sigma a (1 - cos(tau)).
TYPED_TEST(SolverSuite, SlidingWithoutReversal) {
  for (const double direction : {1.0, -1.0}) {
    for (const double sign : {1.0, -1.0}) {
      const Advanced run =
          this->dahl(Case().contact_stiffness(0.7).vibration_sign(sign),
                     lasting(duration).driven(0.4).sliding(0.6 * direction), {0.0, 0.0, 0.2});
      const double travel = direction * 0.6 * duration + sign * 0.4 * (1.0 - std::cos(duration));
      EXPECT_NEAR(run.state.friction, after_travel(0.2, 0.7, travel), TypeParam::smooth);
      EXPECT_EQ(run.cost.events, 0U);
    }
  }
}

/// V = r0 + r1 tau turns once, where half of the way is done.
TYPED_TEST(SolverSuite, SlidingVelocityThroughZero) {
  for (const double direction : {1.0, -1.0}) {
    const Advanced run = this->dahl(Case().contact_stiffness(2.0),
                                    lasting(2.5).sliding(-direction).accelerating(direction));
    const double friction = after_travel(after_travel(0.0, 2.0, -0.5), 2.0, 0.5 * 1.5 * 1.5);
    EXPECT_NEAR(run.state.friction, direction * friction, TypeParam::across);
  }
}

/// No sliding at all: V = a sin(tau) turns at every half period; Vt = 0.
TYPED_TEST(SolverSuite, NothingPulls) {
  for (const double a : {1.0, -1.0}) {
    const Advanced run = this->dahl(Case().contact_stiffness(1.5), lasting(2.5 * pi).driven(a));
    double friction = 0.0;
    for (const double travel : {2.0, -2.0, 1.0}) {
      friction = after_travel(friction, 1.5, a * travel);
    }
    EXPECT_NEAR(run.state.friction, friction, 2.0 * TypeParam::across);
  }
}

/// V = a sin(tau) - a touches zero, with zero acceleration, twice, and never passes it.
TYPED_TEST(SolverSuite, GrazingRest) {
  const double a = 0.1;
  const Advanced run =
      this->dahl(Case().contact_stiffness(0.9), lasting(3.5 * pi).driven(a).sliding(-a));
  EXPECT_NEAR(run.state.friction, after_travel(0.0, 0.9, a - a * 3.5 * pi), TypeParam::across);
}

/// V(0) = 0 and V'(0) = a cos(pi / 2) = 0: the direction is that of V''.
TYPED_TEST(SolverSuite, FromRestWithoutAnAcceleration) {
  for (const double a : {1.0, -1.0}) {
    const Advanced run =
        this->dahl(Case().contact_stiffness(2.0), lasting(1.0).from_phase(0.5 * pi).driven(a));
    EXPECT_NEAR(run.state.friction, after_travel(0.0, 2.0, a * (std::sin(1.0) - 1.0)),
                TypeParam::across);
  }
}

TYPED_TEST(SolverSuite, AtRestWithoutAnyForceNothingMoves) {
  const Advanced run =
      this->dahl(Case().contact_stiffness(1.0).friction_force(0.3).damping(0.1).stiffness(0.5),
                 lasting(duration));
  expect_near(run.state, {0.0, 0.0, 0.0}, 0.0);
}

TYPED_TEST(SolverSuite, NoTimeIsNoStep) {
  const State<double> start = {0.25, -0.5, 0.125};  // in every number type
  const Advanced run =
      this->dahl(Case().contact_stiffness(0.7).friction_force(0.2).damping(0.1).stiffness(0.4),
                 lasting(0.0).driven(1.0).sliding(0.5), start);
  expect_near(run.state, start, 0.0);
  EXPECT_EQ(run.cost.steps, 0U);
}

TYPED_TEST(SolverSuite, NoDriveAndNoSpring) {
  const Advanced run = this->dahl(Case().contact_stiffness(0.8), lasting(duration).sliding(0.25));
  EXPECT_NEAR(run.state.friction, after_travel(0.0, 0.8, 0.25 * duration), TypeParam::smooth);
  EXPECT_EQ(run.state.displacement, 0.0);
}

/// A contact without normal force leaves the oscillator alone.
TYPED_TEST(SolverSuite, NoNormalForce) {
  const Course course = lasting(duration).driven(1.0).sliding(0.3);
  const Advanced with = this->dahl(Case().contact_stiffness(1.0).damping(0.1).stiffness(0.4),
                                   course, {0.2, 0.1, 0.0});
  const Advanced without = run_of<TaylorMethod<double, 16>, DampedFrictionless>(
      Case().damping(0.1).stiffness(0.4), course, {0.2, 0.1, 0.0}, 1e-16);
  EXPECT_NEAR(with.state.displacement, without.state.displacement, TypeParam::smooth);
  EXPECT_NEAR(with.state.velocity, without.state.velocity, TypeParam::smooth);
}

/// Mean of phi over a period on the steady orbit y = -cos(tau) / (1 - k): the closed-form map.
TYPED_TEST(SolverSuite, SteadyFrictionRatio) {
  using Scalar = typename TypeParam::Scalar;
  using Model = DampedDahlModel<Scalar>;
  const double amplitude = 1.0 / 0.7;
  auto solver = configured<typename TypeParam::template Solver<Model>>(
      Model(Case().contact_stiffness(0.404519756998724 / amplitude).stiffness(0.3)),
      static_cast<Scalar>(TypeParam::setting));
  const Interval<Scalar> period = lasting(2.0 * pi).driven(1.0).sliding(0.5 * amplitude);
  State<Scalar> state = {static_cast<Scalar>(-amplitude), Scalar(0), Scalar(0)};
  MeanFriction<Scalar> account;
  for (int i = 0; i < 20; ++i) {
    account = {};
    ASSERT_EQ(advance(solver, period, state, account).error, Error::none);
  }
  EXPECT_NEAR(static_cast<double>(account.friction_integral) / (2.0 * pi), 0.674948666956629,
              4.0 * TypeParam::across);
}

// Contact and oscillator together, against a method of another kind.

Advanced reference(const Case& c, const Course& course, const State<double>& start = {}) {
  return run_of<TaylorMethod<double, 16>>(c, course, start, 1e-16);
}

template <class Method>
void expect_agreement(const Advanced& run, const Advanced& expected, double factor) {
  expect_near(run.state, expected.state, factor * Method::across);
  EXPECT_NEAR(run.account.friction_integral, expected.account.friction_integral,
              factor * Method::across);
  EXPECT_NEAR(run.account.friction_work, expected.account.friction_work, factor * Method::across);
  EXPECT_NEAR(run.account.sliding_work, expected.account.sliding_work, factor * Method::across);
  EXPECT_NEAR(run.account.drive_work, expected.account.drive_work, factor * Method::across);
  EXPECT_NEAR(run.account.damping_work, expected.account.damping_work, factor * Method::across);
}

TYPED_TEST(SolverSuite, ReversingContact) {
  const Course course =
      lasting(3.0 * duration).from_phase(0.8).driven(1.0).sliding(0.4).accelerating(0.01);
  for (const double sign : {1.0, -1.0}) {
    const Case c = Case()
                       .contact_stiffness(1.2)
                       .friction_force(0.3)
                       .vibration_sign(sign)
                       .damping(0.05)
                       .stiffness(0.4);
    expect_agreement<TypeParam>(this->dahl(c, course, {0.3, -0.2, 0.1}),
                                reference(c, course, {0.3, -0.2, 0.1}), 10.0);
  }
}

TYPED_TEST(SolverSuite, OverdampedReversingContact) {
  const Case c = Case().contact_stiffness(1.2).friction_force(0.3).damping(8.0).stiffness(3.0);
  const Course course = lasting(duration).driven(4.0).sliding(0.1);
  expect_agreement<TypeParam>(this->dahl(c, course), reference(c, course), 10.0);
}

TYPED_TEST(SolverSuite, ResonantReversingContact) {
  const Case c = Case().contact_stiffness(0.8).friction_force(0.3).stiffness(1.0);
  const Course course = lasting(2.0 * duration).driven(1.0).sliding(0.5);
  expect_agreement<TypeParam>(this->dahl(c, course), reference(c, course), 50.0);
}

/// A stuck contact rings at sqrt(beta kappa) = 10: some 20 reversals in a period.
TYPED_TEST(SolverSuite, ManyReversalsInAPeriod) {
  const Case c = Case().contact_stiffness(100.0).friction_force(1.0).stiffness(0.1);
  const Course course = lasting(2.0 * pi).driven(0.05);
  const Advanced run = run_of<TypeParam>(c, course, {0.0, 0.02, 0.0});
  const Advanced expected = reference(c, course, {0.0, 0.02, 0.0});
  EXPECT_GT(expected.cost.events, 15U);
  EXPECT_LE(expected.cost.events, 24U);
  EXPECT_EQ(run.error, Error::none);
  EXPECT_NEAR(run.state.displacement, expected.state.displacement, 100.0 * TypeParam::across);
  EXPECT_NEAR(run.state.friction, expected.state.friction, 1000.0 * TypeParam::across);
  EXPECT_NEAR(run.account.friction_integral, expected.account.friction_integral,
              1000.0 * TypeParam::across);
}

TYPED_TEST(SolverSuite, MirroredMotionIsTheMirrorImageBitForBit) {
  const Case c = Case().contact_stiffness(1.2).friction_force(0.3).damping(0.05).stiffness(0.4);
  const State<double> one =
      this->dahl(c, lasting(duration).from_phase(0.3).driven(1.0).sliding(0.4).accelerating(0.01),
                 {0.3, -0.2, 0.1})
          .state;
  const State<double> other =
      this->dahl(c,
                 lasting(duration).from_phase(0.3).driven(-1.0).sliding(-0.4).accelerating(-0.01),
                 {-0.3, 0.2, -0.1})
          .state;
  EXPECT_EQ(one.displacement, -other.displacement);
  EXPECT_EQ(one.velocity, -other.velocity);
  EXPECT_EQ(one.friction, -other.friction);
}

// The bound, however coarse the setting.

/// The largest |phi| inside the steps.
struct LargestFriction {
  double value = 0.0;

  template <class Step>
  void operator()(const Step& step) {
    for (const double part : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      using Scalar = decltype(step.length());
      const auto state = step.at(static_cast<Scalar>(part) * step.length());
      value = std::fmax(value, std::abs(static_cast<double>(state.friction)));
    }
  }
};

/// Either |phi| <= 1 throughout, or the method says that it cannot. The adaptive splitting declines
/// what its steps do not reach; what it has shown until then is within the bound.
TYPED_TEST(SolverSuite, FrictionBoundHoldsOrIsReported) {
  using Scalar = typename TypeParam::Scalar;
  using Model = DampedDahlModel<Scalar>;
  constexpr bool exact_in_displacement = !std::is_same_v<TypeParam, Rk4Method<Scalar>> &&
                                         !std::is_same_v<TypeParam, Rk4EventMethod<Scalar>>;
  constexpr bool declines = std::is_same_v<TypeParam, StrangMethod>;
  int kept = 0;
  for (const double kappa : {0.1, 3.0, 100.0, 1e4, 1e6}) {
    for (const double beta : {0.0, 1e-4, 0.5}) {
      for (const double r : {0.0, 0.01, 0.5, -0.9}) {
        auto solver = configured<typename TypeParam::template Solver<Model>>(
            Model(
                Case().contact_stiffness(kappa).friction_force(beta).damping(0.02).stiffness(0.1)),
            static_cast<Scalar>(TypeParam::coarse_setting));
        State<Scalar> state;
        NoAccount account;
        LargestFriction largest;
        const Error error =
            solver.advance(lasting(2.0 * pi).driven(1.0).sliding(r), state, account, largest).error;
        const double rounding = 64.0 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
        kept += error == Error::none ? 1 : 0;
        if (exact_in_displacement) {
          EXPECT_TRUE(error == Error::none || (declines && error == Error::too_many_steps));
          EXPECT_LE(largest.value, 1.0) << kappa << ' ' << beta << ' ' << r;
        } else if (error == Error::none) {
          // Not by what its steps show, which is clamped.
          EXPECT_LE(std::abs(static_cast<double>(state.friction)), 1.0 + rounding)
              << kappa << ' ' << beta << ' ' << r;
        } else {
          EXPECT_NE(error, Error::too_many_steps);
        }
      }
    }
  }
  EXPECT_GE(kept, declines ? 56 : exact_in_displacement ? 60 : 12);
}

// What a step shows of itself.

/// Integrals of the steps, and whether the steps join.
template <class Scalar>
struct Joined {
  State<Scalar> last;
  Scalar velocity_square = Scalar(0);
  Scalar displacement_square = Scalar(0);
  double worst_gap = 0.0;
  double worst_jump = 0.0;
  Scalar covered = Scalar(0);

  template <class Step>
  void operator()(const Step& step) {
    const State<Scalar> first = step.at(Scalar(0));
    worst_gap = std::fmax(worst_gap, std::abs(static_cast<double>(step.begin() - covered)));
    for (const double jump : {static_cast<double>(first.displacement - last.displacement),
                              static_cast<double>(first.velocity - last.velocity),
                              static_cast<double>(first.friction - last.friction)}) {
      worst_jump = std::fmax(worst_jump, std::abs(jump));
    }
    covered = step.begin() + step.length();
    last = step.at(step.length());
    const MotionIntegrals<Scalar> motion = step.motion_integrals();
    velocity_square += motion.velocity_square;
    displacement_square += motion.displacement_square;
  }
};

/// Of one carrier period from the free mass's steady orbit.
template <class Method>
Joined<typename Method::Scalar> joined(const Case& c) {
  using Scalar = typename Method::Scalar;
  using Model = DampedDahlModel<Scalar>;
  auto solver = configured<typename Method::template Solver<Model>>(
      Model(c), static_cast<Scalar>(Method::setting));
  State<Scalar> state = {Scalar(-1), Scalar(0), Scalar(0)};
  Joined<Scalar> joined;
  joined.last = state;
  NoAccount account;
  const Interval<Scalar> interval = lasting(2.0 * pi).driven(1.0).sliding(0.4);
  EXPECT_EQ(solver.advance(interval, state, account, joined).error, Error::none);
  const double rounding = 32.0 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  EXPECT_LT(joined.worst_gap, rounding);
  EXPECT_LT(joined.worst_jump, rounding);
  EXPECT_NEAR(static_cast<double>(joined.covered), 2.0 * pi, rounding);
  return joined;
}

/// Steps that are taken again leave no trace.
TYPED_TEST(SolverSuite, StepsJoin) {
  joined<TypeParam>(Case().contact_stiffness(0.9).friction_force(0.3).damping(0.2).stiffness(0.6));
}

/// y = -cos(tau), v = sin(tau).
TYPED_TEST(SolverSuite, StepsIntegrateTheMotion) {
  const auto found = joined<TypeParam>(Case().contact_stiffness(1.2));
  EXPECT_NEAR(static_cast<double>(found.velocity_square), pi, 10.0 * TypeParam::smooth);
  EXPECT_NEAR(static_cast<double>(found.displacement_square), pi, 10.0 * TypeParam::smooth);
}

}  // namespace
}  // namespace sonoglide::plant::solver_suite_test
