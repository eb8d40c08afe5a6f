/// Vibration normal to the surface: closed-form ratio, a contact that opens, energy, and the slider
/// followed in short steps.

#include "firmware/friction/normal_coulomb.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware/friction/normal_vibration_ratio.hpp"
#include "law_runs.hpp"

namespace sonoglide::plant::normal_coulomb_test {
namespace {

using Law = friction::NormalCoulomb<double>;
using PlantModel = LawModel<Law>;

/// Begins where a slipping contact is at its lowest limit.
template <class Solver>
double slipping_ratio(const Solver& solver, const Law& law, double velocity_ratio) {
  return mean_friction(solver, {-1.0, 0.0, std::copysign(law.limit(-1.0), velocity_ratio)},
                       velocity_ratio, 1);
}

TEST(NormalCoulomb, MeanUnderPrescribedVibrationIsTheClosedForm) {
  for (const double amplitude : {0.05, 0.4, 0.99}) {
    for (const double s : {0.003, 0.1, 0.3, 0.6, 0.9, 0.999, 1.0, 1.7}) {
      const double stiffness = 20.0;
      const double r = s * amplitude / stiffness;
      const Law law = {stiffness, amplitude};
      const auto solver = taylor(law, 1e-13);
      const double expected = friction::normal_vibration_ratio(amplitude, s);
      EXPECT_NEAR(slipping_ratio(solver, law, r), expected, 1e-12) << amplitude << ' ' << s;
      EXPECT_NEAR(slipping_ratio(solver, law, -r), -expected, 1e-12) << amplitude << ' ' << s;
    }
  }
}

TEST(NormalCoulomb, ToleranceIsThatOfTheMeanFriction) {
  const Law law = {20.0, 0.7};
  const double expected = friction::normal_vibration_ratio(0.7, 0.4);
  const auto mean = [&](const auto& solver) {
    return slipping_ratio(solver, law, 0.4 * 0.7 / 20.0);
  };
  expect_tolerance_is_that_of_the_mean(law, Case(), mean, expected);
}

TEST(NormalCoulomb, MeanInSinglePrecision) {
  EXPECT_NEAR(
      prescribed_ratio(taylor<8>(friction::NormalCoulomb<float>{20.0F, 0.7F}, 1e-6), 0.014, 2),
      friction::normal_vibration_ratio(0.7, 0.4), 5e-6);
}

/// Where it begins to stick and where it slips again; nothing else is stopped at.
TEST(NormalCoulomb, FindsTwoCornersInAPeriod) {
  auto solver = taylor(Law{20.0, 0.7}, 1e-10);
  State<double> state = {-1.0, 0.0, 0.3};
  NoAccount account;
  EXPECT_EQ(run_periods(solver, 50, 1.0, 0.014, state, account), Error::none);
  EXPECT_GE(solver.cost().events, 99U);
  EXPECT_LE(solver.cost().events, 101U);
}

/// At its limit and pulled by nothing: to slip or to stick is the same.
TEST(NormalCoulomb, StandsStillWhereNothingMoves) {
  auto solver = taylor(Law{3.0, 0.5}, 1e-12);
  const State<double> state = advanced(solver, lasting(6.0), {0.0, 0.0, 1.0});
  EXPECT_EQ(state.friction, 1.0);
  EXPECT_EQ(solver.cost().events, 0U);
}

TEST(NormalCoulomb, LeavesTheOscillatorAlone) {
  using Free = Model<friction::None<double>, Damped<double>, CosineDrive>;
  const Interval<double> interval =
      lasting(30.0).from_phase(0.3).driven(1.0).sliding(0.1).accelerating(0.01);
  const Case c = Case().friction_force(0.4).damping(0.05).stiffness(0.2);
  auto solver = taylor(Law{20.0, 0.5}, 1e-13, c);
  auto free = configured<EventTaylor<Free, 16>>(c, 1e-13);
  const State<double> state = advanced(solver, interval, {0.4, 0.1, 0.0});
  const State<double> expected = advanced(free, interval, {0.4, 0.1, 0.0});
  EXPECT_NEAR(state.displacement, expected.displacement, 1e-12);
  EXPECT_NEAR(state.velocity, expected.velocity, 1e-12);
}

TEST(NormalCoulomb, MirroredPullIsTheMirrorImageBitForBit) {
  expect_mirror_image(Law{20.0, 0.5}, 0.5);
}

/// The slider in steps so short that it need only be moved back to its limit behind each, beside
/// y = -cos tau.
struct Followed {
  double friction;
  double integral;
};
Followed follow(const Law& law, const Interval<double>& interval, double friction) {
  constexpr int steps = 2000000;
  const double step = interval.duration / steps;
  Followed followed = {friction, 0.0};
  for (int i = 0; i < steps; ++i) {
    const double middle = (i + 0.5) * step;
    const double limit = law.limit(-std::cos((i + 1) * step));
    const double r = interval.sliding_velocity + interval.sliding_acceleration * middle;
    const double before = followed.friction;
    followed.friction = std::clamp(before + law.contact_stiffness * r * step, -limit, limit);
    followed.integral += 0.5 * step * (before + followed.friction);
  }
  return followed;
}

/// Vibration that lifts the mass off the surface, a pull that turns round, and both.
TEST(NormalCoulomb, AgreesWithTheSliderFollowedInShortSteps) {
  for (const double normal : {0.3, 0.999, 1.0, 1.5, 6.0}) {
    for (const double stiffness : {0.3, 4.0, 200.0}) {
      for (const double acceleration : {0.0, -0.03}) {
        const Law law = {stiffness, normal};
        const Interval<double> interval =
            lasting(20.0).driven(1.0).sliding(0.2).accelerating(acceleration);
        auto solver = taylor(law, 1e-12);
        State<double> state = {-1.0, 0.0, 0.0};
        MeanFriction<double> account;
        EXPECT_EQ(advance(solver, interval, state, account).error, Error::none);
        const Followed expected = follow(law, interval, 0.0);
        EXPECT_NEAR(state.friction, expected.friction, 1e-4) << normal << ' ' << stiffness;
        EXPECT_NEAR(account.friction_integral, expected.integral, 2e-4)
            << normal << ' ' << stiffness << ' ' << acceleration;
        EXPECT_GE(solver.cost().steps, 4U);
        EXPECT_LE(solver.cost().steps, 80U);
      }
    }
  }
}

RC_GTEST_PROP(NormalCoulombProperties, KeepsItsLimitBalancesItsEnergyAndIsPassive, ()) {
  const Law law = {std::pow(10.0, between(-2.0, 3.0)), between(0.01, 3.0)};
  const PlantModel model = random_case().of(law);
  State<double> before = random_motion(law);
  before.friction = law.limit(before.displacement) * between(-1.0, 1.0);
  auto solver = configured<EventTaylor<PlantModel, 16>>(model, 1e-12);
  const auto [state, account] = balanced(solver, model, before, between(-2.0, 2.0));
  RC_ASSERT(std::abs(state.friction) <= law.limit(state.displacement));
  RC_ASSERT(solver.cost().steps < 100U);
  const auto stored = [&](const State<double>& at) {
    return at.friction * at.friction / (2.0 * law.contact_stiffness);
  };
  RC_ASSERT(account.friction_work >= stored(state) - stored(before) - 1e-9);
}

}  // namespace
}  // namespace sonoglide::plant::normal_coulomb_test
