/// Cubic Stribeck contact against closed forms: prescribed vibration, slip, stick, and dither.

#include "firmware/friction/stribeck.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "firmware/friction/stribeck_friction_ratio.hpp"
#include "law_runs.hpp"

namespace sonoglide::plant::stribeck_test {
namespace {

using Law = friction::Stribeck<double>;
using PlantModel = LawModel<Law>;

TEST(Stribeck, MeanUnderPrescribedVibration) {
  const Law law = {0.6, 0.2};
  for (const double ratio : {-0.3, 0.1, 0.5, 0.9, 1.5}) {
    const double expected = friction::stribeck_friction_ratio(ratio, 0.6, 0.2);
    EXPECT_NEAR(prescribed_ratio(taylor(law, 1e-13), ratio), expected, 1e-12);
    EXPECT_NEAR(prescribed_ratio(fixed_steps(law, 1e-4), ratio), expected, 1e-4);
  }
}

TEST(Stribeck, MeanInSinglePrecision) {
  EXPECT_NEAR(prescribed_ratio(taylor<8>(friction::Stribeck<float>{0.6F, 0.2F}, 1e-7), 0.5),
              friction::stribeck_friction_ratio(0.5, 0.6, 0.2), 1e-5);
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
  const Case c = Case().friction_force(0.6).damping(0.05).stiffness(0.2);
  auto solver = taylor(Law(), 1e-12, c);
  auto coulomb = configured<EventTaylor<DampedCoulombModel<double>, 16>>(c, 1e-12);
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
  const Case c = Case().friction_force(beta).stiffness(k);
  auto exact = taylor(Law{a, 0.0}, 1e-13, c);
  auto fixed = fixed_steps(Law{a, 0.0}, 1e-3, c);
  EXPECT_NEAR(advanced(exact, lasting(t).sliding(r), {}).displacement, expected, 1e-12);
  EXPECT_NEAR(advanced(fixed, lasting(t).sliding(r), {}).displacement, expected, 1e-11);
  EXPECT_EQ(exact.cost().events, 0U);
}

/// A contact that holds is loaded by its spring, phi = k r t / beta, and lets go at phi = 1.
TEST(Stribeck, SticksUntilTheSpringPullsItLoose) {
  auto solver = taylor(Law{0.4, 0.1}, 1e-13, Case().friction_force(0.3).stiffness(0.5));
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
  const Case c = Case().friction_force(beta).stiffness(k);
  State<double> quiet;
  State<double> dithered = {-1.0, 0.0, 0.0};
  NoAccount account;
  auto without = taylor<8>(law, 1e-6, c);
  EXPECT_EQ(run_periods(without, 2000, 0.0, r, quiet, account), Error::none);
  const auto events_before = without.cost().events;
  EXPECT_EQ(run_periods(without, 500, 0.0, r, quiet, account), Error::none);
  // A stick and a release in each of ten natural periods; no more than two events a carrier period.
  EXPECT_GE(without.cost().events - events_before, 10U);
  EXPECT_LE(without.cost().events - events_before, 1000U);

  auto with = taylor<8>(law, 1e-6, c);
  EXPECT_EQ(run_periods(with, 4000, 1.0, r, dithered, account), Error::none);
  const double rest = -beta / k * friction::stribeck_friction_ratio(r, law.fall, law.rise);
  EXPECT_NEAR(dithered.displacement, rest - 1.0, 0.05);
  EXPECT_NEAR(dithered.velocity, 0.0, 0.005);
}

TEST(Stribeck, MirroredMotionIsTheMirrorImageBitForBit) {
  expect_mirror_image(Law{0.6, 0.2}, 0.0);
}

RC_GTEST_PROP(StribeckProperties, BalancesItsEnergyAndIsPassive, ()) {
  const double fall = between(0.0, 1.5);
  const Law law = {fall, 4.0 / 27.0 * fall * fall * fall * between(1.0, 2.0)};
  const PlantModel model = random_case().of(law);
  auto solver = configured<EventTaylor<PlantModel, 16>>(model, 1e-12);
  const auto moved = balanced(solver, model, random_motion(law), between(-2.0, 2.0));
  RC_ASSERT(moved.account.friction_work >= -1e-9);
}

}  // namespace
}  // namespace sonoglide::plant::stribeck_test
