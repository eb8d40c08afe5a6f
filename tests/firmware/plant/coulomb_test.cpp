/// Coulomb contact against closed forms: sliding, sticking, stick-slip, decay.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::coulomb_test {
namespace {

using Contact = CoulombModel<double>;
using DampedContact = DampedCoulombModel<double>;
using Taylor = EventTaylor<Contact, 16>;
using DampedTaylor = EventTaylor<DampedContact, 16>;

constexpr double tolerance = 1e-14;

struct SlidingRatios {
  double friction_ratio;
  double dissipation_ratio;
};

/// Prescribed sinusoidal motion: no reaction of friction on the motion, start on the steady orbit.
SlidingRatios prescribed(double velocity_ratio) {
  const double k = 0.3;
  const double peak_velocity = 1.0 / (1.0 - k);
  const double r = velocity_ratio * peak_velocity;
  auto solver = configured<Taylor>(Case().stiffness(k), tolerance);
  State<double> state = {-peak_velocity, 0.0, 1.0};
  EnergyAccount<double> account;
  EXPECT_EQ(run_periods(solver, 20, 1.0, r, state, account), Error::none);
  return {account.friction_integral / (40.0 * pi), account.friction_work / (40.0 * pi * r)};
}

TEST(CoulombPrescribedMotion, FrictionRatioIsThatOfTheArcSine) {
  for (const double ratio : {1e-6, 0.1, 0.3, 0.5, 0.8, 0.95, 0.999999}) {
    EXPECT_NEAR(prescribed(ratio).friction_ratio, 2.0 / pi * std::asin(ratio), 1e-12) << ratio;
  }
  EXPECT_NEAR(prescribed(0.1).friction_ratio, 0.06377, 5e-6);
  EXPECT_NEAR(prescribed(0.5).friction_ratio, 0.33333, 5e-6);
  EXPECT_NEAR(prescribed(0.95).friction_ratio, 0.79783, 5e-6);
}

TEST(CoulombPrescribedMotion, FrictionIsFullWhereVibrationIsSlower) {
  for (const double ratio : {1.000001, 1.5, 40.0}) {
    EXPECT_NEAR(prescribed(ratio).friction_ratio, 1.0, 1e-13);
    EXPECT_NEAR(prescribed(-ratio).friction_ratio, -1.0, 1e-13);
  }
}

TEST(CoulombPrescribedMotion, NegativeSlidingMirrorsTheRatio) {
  EXPECT_NEAR(prescribed(-0.3).friction_ratio, -prescribed(0.3).friction_ratio, 1e-13);
}

TEST(CoulombPrescribedMotion, DissipationRatio) {
  EXPECT_NEAR(prescribed(0.1).dissipation_ratio, 6.398, 5e-4);
  EXPECT_NEAR(prescribed(0.5).dissipation_ratio, 1.4360, 5e-5);
  EXPECT_NEAR(prescribed(0.9).dissipation_ratio, 1.0212, 5e-5);
  for (const double ratio : {0.01, 0.5, 0.99}) {
    const double expected = 2.0 / pi * (std::asin(ratio) + std::sqrt(1.0 - ratio * ratio) / ratio);
    EXPECT_NEAR(prescribed(ratio).dissipation_ratio / expected, 1.0, 1e-12);
  }
}

TEST(CoulombStick, HoldsAgainstAForceBelowTheLimit) {
  auto solver = configured<Taylor>(Case().friction_force(1.0), tolerance);
  State<double> state;
  EnergyAccount<double> account;
  const Interval<double> interval = lasting(7.0).driven(0.999);
  EXPECT_EQ(advance(solver, interval, state, account).error, Error::none);
  EXPECT_EQ(state.velocity, 0.0);
  EXPECT_EQ(state.displacement, 0.0);
  EXPECT_NEAR(state.friction, 0.999 * std::cos(7.0), 1e-13);
  EXPECT_NEAR(account.friction_integral, 0.999 * std::sin(7.0), 1e-13);
  EXPECT_EQ(account.friction_work, 0.0);
}

TEST(CoulombStick, CarriesTheMassAlongAVaryingSlidingVelocity) {
  auto solver =
      configured<DampedTaylor>(Case().friction_force(2.0).damping(0.4).stiffness(0.1), tolerance);
  const State<double> end =
      advanced(solver, lasting(3.0).from_phase(0.5).driven(0.2).sliding(0.3).accelerating(-0.05),
               {1.0, -0.3, 0.0});
  EXPECT_NEAR(end.displacement, 1.0 - 0.3 * 3.0 + 0.5 * 0.05 * 9.0, 1e-14);
  EXPECT_NEAR(end.velocity, -0.3 + 0.05 * 3.0, 1e-15);
  const double held = 0.2 * std::cos(3.5) - 0.4 * end.velocity - 0.1 * end.displacement - 0.05;
  EXPECT_NEAR(end.friction, held / 2.0, 1e-14);
}

TEST(CoulombStick, OutlastsTheInterval) {
  auto solver = configured<Taylor>(Case().friction_force(1.0).stiffness(0.1), tolerance);
  State<double> state = {0.0, -0.3, 0.0};
  NoAccount account;
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(
        advance(solver, lasting(0.1).sliding(0.3 + 0.01 * i).accelerating(0.1), state, account)
            .error,
        Error::none);
  }
  EXPECT_NEAR(state.velocity, -0.4, 1e-15);
  EXPECT_NEAR(state.displacement, -0.35, 1e-14);
}

/// Pulled at constant speed through a spring: sticks until k r t = beta, then slides along
/// y = -beta / k - r / w sin(w t), whose sliding velocity r (1 - cos(w t)) touches zero, with zero
/// acceleration, once in each period.
TEST(CoulombStickSlip, ReleasesInTimeAndTouchesRestEveryPeriod) {
  const double k = 0.8;
  const double w = std::sqrt(k);
  const double beta = 0.6;
  const double r = 0.25;
  const double release = beta / (k * r);
  for (const double direction : {1.0, -1.0}) {
    auto solver = configured<Taylor>(Case().friction_force(beta).stiffness(k), tolerance);
    State<double> state = {0.0, -direction * r, 0.0};
    NoAccount account;
    EXPECT_EQ(advance(solver, lasting(0.99 * release).sliding(direction * r), state, account).error,
              Error::none);
    EXPECT_NEAR(state.friction, direction * 0.99, 1e-14);
    EXPECT_NEAR(state.displacement, -direction * 0.99 * r * release, 1e-14);
    const double slid = 3.7 * 2.0 * pi / w;
    EXPECT_EQ(advance(solver, lasting(0.01 * release + slid).sliding(direction * r), state, account)
                  .error,
              Error::none);
    EXPECT_NEAR(state.displacement, -direction * (beta / k + r / w * std::sin(w * slid)), 1e-7);
    EXPECT_EQ(state.friction, direction);
    EXPECT_GE(solver.cost().steps, 6U);  // two sticks, a slide a touch
    EXPECT_LT(solver.cost().steps, 200U);
  }
}

/// Held against a damper by a pull that turns round: released where d r + dr/dt = -beta, close to
/// r = 0. The acceleration from there is zero but for the rounding of r.
TEST(CoulombStickSlip, ReleasesBesideTheTurnOfThePull) {
  const double d = 33.0;
  const double beta = 0.28;
  const double r0 = 0.676;
  const double r1 = -0.253;
  const double release = ((-beta - r1) / d - r0) / r1;
  for (const double phase : {0.0, 1.0, 6.0}) {
    auto solver = configured<DampedTaylor>(Case().friction_force(beta).damping(d), tolerance);
    State<double> state = {0.0, -r0, 0.0};
    NoAccount account;
    const double held = release * (1.0 - 1e-9);
    EXPECT_EQ(advance(solver, lasting(held).from_phase(phase).sliding(r0).accelerating(r1), state,
                      account)
                  .error,
              Error::none);
    EXPECT_EQ(state.velocity, -(r0 + r1 * held));
    const State<double> end =
        advanced(solver, lasting(release + 1.0).from_phase(phase).sliding(r0).accelerating(r1),
                 {0.0, -r0, 0.0});
    // From there v' = beta - d v, with v' = -r1 at first.
    EXPECT_NEAR(end.velocity, (beta + r1 * std::exp(-d)) / d, 1e-13);
    EXPECT_EQ(end.friction, -1.0);
    EXPECT_GE(solver.cost().steps, 3U);  // a stick, a stick and a slide
    EXPECT_LT(solver.cost().steps, 100U);
  }
}

/// Free vibration over a dry floor: each half cycle shortens the swing by 2 beta / k.
TEST(CoulombDecay, LosesTheSameSwingEachHalfCycleAndThenStands) {
  const double k = 2.0;
  const double beta = 0.1;
  const double half_cycle = pi / std::sqrt(k);
  auto solver = configured<Taylor>(Case().friction_force(beta).stiffness(k), tolerance);
  State<double> state = {1.03, 0.0, 0.0};
  NoAccount account;
  double swing = 1.03;
  for (int n = 0; n < 10; ++n) {
    EXPECT_EQ(advance(solver, lasting(half_cycle), state, account).error, Error::none);
    swing = -swing + (swing > 0.0 ? 1.0 : -1.0) * 2.0 * beta / k;
    EXPECT_NEAR(state.displacement, swing, 1e-12) << n;
    EXPECT_NEAR(state.velocity, 0.0, 1e-12) << n;
  }
  EXPECT_EQ(advance(solver, lasting(100.0), state, account).error, Error::none);
  EXPECT_NEAR(state.displacement, 0.03, 1e-12);
  EXPECT_EQ(state.velocity, 0.0);
  EXPECT_NEAR(state.friction, -k * 0.03 / beta, 1e-10);
}

/// With the printed sign friction pumps: the swing grows by as much, and nothing ever sticks.
TEST(CoulombDecay, PrintedSignGrowsTheSwing) {
  const double k = 2.0;
  const double beta = 0.1;
  auto solver =
      configured<Taylor>(Case().friction_force(beta).vibration_sign(-1.0).stiffness(k), tolerance);
  State<double> state = {1.0, 0.0, 0.0};
  NoAccount account;
  EXPECT_EQ(advance(solver, lasting(10.0 * pi / std::sqrt(k)), state, account).error, Error::none);
  EXPECT_NEAR(state.displacement, 1.0 + 10.0 * 2.0 * beta / k, 1e-11);
}

TEST(CoulombRest, NothingHappensWithoutAnyForce) {
  for (const double beta : {0.0, 1.0}) {
    for (const double sign : {1.0, -1.0}) {
      auto solver = configured<Taylor>(
          Case().friction_force(beta).vibration_sign(sign).stiffness(1.0), tolerance);
      const State<double> end = advanced(solver, lasting(20.0), {});
      EXPECT_EQ(end.displacement, 0.0);
      EXPECT_EQ(end.velocity, 0.0);
      EXPECT_EQ(end.friction, 0.0);
    }
  }
}

}  // namespace
}  // namespace sonoglide::plant::coulomb_test
