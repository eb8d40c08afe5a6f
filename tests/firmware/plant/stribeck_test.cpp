/// Cubic Stribeck contact against closed forms: prescribed vibration, slip, stick, and dither.

#include "firmware/friction/stribeck.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "firmware/friction/stribeck_friction_ratio.hpp"
#include "random.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::stribeck_test {
namespace {

using Law = friction::Stribeck<double>;
using PlantModel = Model<Law, Damped<double>, CosineDrive>;
using Taylor = EventTaylor<PlantModel, 16>;
using FixedSteps = Rk4<PlantModel>;

PlantModel model_of(const Law& law, double friction_force = 0.0, double stiffness = 0.0,
                    double damping = 0.0) {
  return {{law, friction_force, 1.0}, {damping}, stiffness};
}

template <class Solver>
double prescribed_ratio(const Law& law, double velocity_ratio, double setting) {
  auto solver = configured<Solver>(model_of(law), setting);
  State<double> state = {-1.0, 0.0, 0.0};
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, 1, 1.0, velocity_ratio, state, account), Error::none);
  return account.friction_integral / (2.0 * pi);
}

TEST(Stribeck, MeanUnderPrescribedVibration) {
  const Law law = {0.6, 0.2};
  for (const double ratio : {-0.3, 0.1, 0.5, 0.9, 1.5}) {
    const double expected = friction::stribeck_friction_ratio(ratio, 0.6, 0.2);
    EXPECT_NEAR(prescribed_ratio<Taylor>(law, ratio, 1e-13), expected, 1e-12);
    EXPECT_NEAR(prescribed_ratio<FixedSteps>(law, ratio, 1e-4), expected, 1e-4);
  }
}

TEST(Stribeck, MeanInSinglePrecision) {
  using Single = Model<friction::Stribeck<float>, Damped<float>, CosineDrive>;
  auto solver =
      configured<EventTaylor<Single, 8>>({{{0.6F, 0.2F}, 0.0F, 1.0F}, {0.0F}, 0.0F}, 1e-7F);
  State<float> state = {-1.0F, 0.0F, 0.0F};
  MeanFriction<float> account;
  EXPECT_EQ(run_periods(solver, 1, 1.0F, 0.5F, state, account), Error::none);
  EXPECT_NEAR(account.friction_integral / static_cast<float>(2.0 * pi),
              friction::stribeck_friction_ratio(0.5F, 0.6F, 0.2F), 1e-5F);
}

TEST(Stribeck, MeanWithoutItsCurveIsCoulombs) {
  EXPECT_NEAR(friction::stribeck_friction_ratio(0.3, 0.0, 0.0), 0.19397, 1e-5);
  EXPECT_NEAR(friction::stribeck_friction_ratio(-0.8, 0.0, 0.0), -0.59033, 1e-5);
}

/// (2/pi) asin(1/2) - 0.6 / 2 + 0.2 (1/8 + 3/4).
TEST(Stribeck, MeanOfOneCase) {
  EXPECT_NEAR(friction::stribeck_friction_ratio(0.5, 0.6, 0.2), 1.0 / 3.0 - 0.3 + 0.175, 1e-15);
}

TEST(Stribeck, WithoutItsCurveIsCoulomb) {
  const Interval<double> interval =
      lasting(30.0).from_phase(0.3).driven(1.0).sliding(0.3).accelerating(0.01);
  auto solver = configured<Taylor>(model_of({}, 0.6, 0.2, 0.05), 1e-12);
  auto coulomb = configured<EventTaylor<DampedCoulombModel<double>, 16>>(
      Case().friction_force(0.6).damping(0.05).stiffness(0.2), 1e-12);
  const State<double> state = advanced(solver, interval, {0.4, 0.1, 0.0});
  const State<double> expected = advanced(coulomb, interval, {0.4, 0.1, 0.0});
  EXPECT_GT(coulomb.cost().events, 4U);
  EXPECT_LE(coulomb.cost().events, 20U);
  EXPECT_EQ(solver.cost().events, coulomb.cost().events);
  EXPECT_NEAR(state.displacement, expected.displacement, 1e-11);
  EXPECT_NEAR(state.velocity, expected.velocity, 1e-11);
  EXPECT_NEAR(state.friction, expected.friction, 1e-10);
}

/// Friction that falls in proportion to V is a negative damping while the contact slips.
TEST(Stribeck, SlipWithAFallingForceGrows) {
  const double a = 0.4;
  const double beta = 0.3;
  const double k = 0.7;
  const double r = 2.0;
  const double growth = 0.5 * beta * a;
  const double w = std::sqrt(k - growth * growth);
  const double rest = -beta * (1.0 - a * r) / k;
  const double t = 12.0;
  const double expected =
      rest - rest * std::exp(growth * t) * (std::cos(w * t) - growth / w * std::sin(w * t));
  auto taylor = configured<Taylor>(model_of({a, 0.0}, beta, k), 1e-13);
  auto fixed = configured<FixedSteps>(model_of({a, 0.0}, beta, k), 1e-3);
  EXPECT_NEAR(advanced(taylor, lasting(t).sliding(r), {}).displacement, expected, 1e-12);
  EXPECT_NEAR(advanced(fixed, lasting(t).sliding(r), {}).displacement, expected, 1e-11);
  EXPECT_EQ(taylor.cost().events, 0U);
}

/// A contact that holds is loaded by its spring, phi = k r t / beta, and lets go at phi = 1.
TEST(Stribeck, SticksUntilTheSpringPullsItLoose) {
  auto solver = configured<Taylor>(model_of({0.4, 0.1}, 0.3, 0.5), 1e-13);
  const double r = 0.1;
  State<double> state = {0.0, -r, 0.0};
  state = advanced(solver, lasting(4.0).sliding(r), state);
  EXPECT_NEAR(state.friction, 0.5 * r * 4.0 / 0.3, 1e-12);
  EXPECT_EQ(state.velocity, -r);
  state = advanced(solver, lasting(3.0).from_phase(4.0).sliding(r), state);
  EXPECT_GT(state.velocity, -r);
}

/// Slow sliding on the falling curve: without dither it sticks and slips without end; with dither
/// the averaged force rises with the speed, and the body comes to rest at -beta rho / k but for the
/// dither's own motion.
TEST(Stribeck, DitherQuenchesStickSlip) {
  const Law law = {0.5, 0.1};
  const double beta = 0.005;
  const double k = 4e-4;
  const double r = 0.2;
  const PlantModel model = model_of(law, beta, k);
  State<double> quiet;
  State<double> dithered = {-1.0, 0.0, 0.0};
  NoAccount account;
  auto without = configured<EventTaylor<PlantModel, 8>>(model, 1e-6);
  EXPECT_EQ(run_periods(without, 2000, 0.0, r, quiet, account), Error::none);
  const auto events_before = without.cost().events;
  EXPECT_EQ(run_periods(without, 500, 0.0, r, quiet, account), Error::none);
  // A stick and a release in each of ten natural periods; no more than two events a carrier period.
  EXPECT_GE(without.cost().events - events_before, 10U);
  EXPECT_LE(without.cost().events - events_before, 1000U);

  auto with = configured<EventTaylor<PlantModel, 8>>(model, 1e-6);
  EXPECT_EQ(run_periods(with, 4000, 1.0, r, dithered, account), Error::none);
  const double rest = -beta / k * friction::stribeck_friction_ratio(r, law.fall, law.rise);
  EXPECT_NEAR(dithered.displacement, rest - 1.0, 0.05);
  EXPECT_NEAR(dithered.velocity, 0.0, 0.005);
}

TEST(Stribeck, MirroredMotionIsTheMirrorImageBitForBit) {
  auto solver = configured<Taylor>(model_of({0.6, 0.2}, 0.6, 0.2, 0.05), 1e-12);
  const State<double> one =
      advanced(solver, lasting(30.0).from_phase(0.3).driven(1.0).sliding(0.3).accelerating(0.01),
               {0.4, 0.1, 0.0});
  const State<double> other =
      advanced(solver, lasting(30.0).from_phase(0.3).driven(-1.0).sliding(-0.3).accelerating(-0.01),
               {-0.4, -0.1, 0.0});
  EXPECT_EQ(one.displacement, -other.displacement);
  EXPECT_EQ(one.velocity, -other.velocity);
}

RC_GTEST_PROP(StribeckProperties, BalancesItsEnergyAndIsPassive, ()) {
  const double fall = between(0.0, 1.5);
  const Law law = {fall, 4.0 / 27.0 * fall * fall * fall * between(1.0, 2.0)};
  const PlantModel model = model_of(law, between(0.0, 0.5), between(0.0, 2.0), between(0.0, 0.3));
  const State<double> before = {between(-1.0, 1.0), between(-1.0, 1.0), 0.0};
  auto solver = configured<Taylor>(model, 1e-12);
  State<double> state = before;
  EnergyAccount<double> account;
  RC_ASSERT(run_periods(solver, 2, between(0.0, 2.0), between(-2.0, 2.0), state, account) ==
            Error::none);
  RC_ASSERT(std::abs(account.balance_residual(model, before, state)) < 1e-9);
  RC_ASSERT(account.friction_work >= -1e-9);
}

}  // namespace
}  // namespace sonoglide::plant::stribeck_test
